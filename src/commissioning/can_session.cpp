#include "interpolated_motion_driver/commissioning/can_session.h"

#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"

namespace interpolated_motion::commissioning {
namespace {

/// A bus that had no room is offered what waits again after this time, as it may not say when it has.
constexpr HostDuration kRetry = std::chrono::milliseconds(5);

}  // namespace

CanSession::CanSession(transport::CanBus& bus, Waiter& waiter, std::uint32_t bitrate,
                       const canopen::SdoParameters& parameters)
    : bus_(bus), waiter_(waiter), parameters_(parameters), traffic_(bitrate) {}

void CanSession::listen(HostDuration duration) {
  const HostTime end = waiter_.now() + duration;
  receive(nullptr);
  while (waiter_.now() < end) {
    waiter_.wait(end);
    receive(nullptr);
  }
}

std::vector<canopen::SdoResult> CanSession::transfer(std::vector<SdoOrder> orders, const Progress& progress) {
  SdoBatch batch(std::move(orders), parameters_);
  std::size_t told = 0;
  outgoing_.clear();
  while (!batch.done()) {
    send(batch);
    const HostTime retry = outgoing_.empty() ? kNever : waiter_.now() + kRetry;
    waiter_.wait(std::min(batch.next_deadline(), retry));
    receive(&batch);
    batch.poll(waiter_.now());
    if (progress && batch.finished() > told) progress(batch.finished(), batch.results().size());
    told = batch.finished();
  }
  send(batch);
  return batch.results();
}

canopen::SdoResult CanSession::read(std::uint8_t node, canopen::ObjectAddress address) {
  return transfer({{node, address, std::nullopt}}).front();
}

canopen::SdoResult CanSession::write(std::uint8_t node, canopen::ObjectAddress address,
                                     std::vector<std::uint8_t> data) {
  return transfer({{node, address, std::move(data)}}).front();
}

void CanSession::receive(SdoBatch* batch) {
  while (const auto received = bus_.receive()) {
    traffic_.on_frame(*received);
    const bool answer = canopen::classify(received->frame.id).service == canopen::Service::SdoResponse;
    if (batch != nullptr && answer && !received->own) batch->on_frame(received->frame, received->time);
  }
}

void CanSession::send(SdoBatch& batch) {
  const HostTime now = waiter_.now();
  while (true) {
    if (outgoing_.empty()) {
      const auto frame = batch.next_frame(now);
      if (!frame) return;
      outgoing_.push_back(*frame);
      traffic_.on_sending(*frame);
    }
    if (!bus_.send(outgoing_.front(), now)) return;
    outgoing_.pop_front();
  }
}

}  // namespace interpolated_motion::commissioning
