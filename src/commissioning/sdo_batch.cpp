#include "interpolated_motion_driver/commissioning/sdo_batch.h"

#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"

namespace interpolated_motion::commissioning {
namespace {

constexpr int kReadAttempts = 2;

bool is_silence(const canopen::SdoResult& result) {
  return !result.ok && !result.aborted_by_drive && result.abort_code == canopen::abort_code::kTimeout;
}

}  // namespace

SdoBatch::SdoBatch(std::vector<SdoOrder> orders, const canopen::SdoParameters& parameters)
    : orders_(std::move(orders)), parameters_(parameters), results_(orders_.size()) {
  for (std::size_t i = 0; i < orders_.size(); ++i) waiting_.push_back(i);
}

void SdoBatch::start(Running& running, HostTime now) const {
  const SdoOrder& order = orders_[running.order];
  ++running.attempts;
  if (order.data) {
    running.client.start_download(order.address, *order.data, now);
  } else {
    running.client.start_upload(order.address, now);
  }
}

bool SdoBatch::is_running(std::uint8_t node) const {
  return std::any_of(running_.begin(), running_.end(),
                     [node](const Running& running) { return running.client.node() == node; });
}

void SdoBatch::start_waiting(HostTime now) {
  for (auto next = waiting_.begin(); next != waiting_.end() && running_.size() < kSideBySide;) {
    if (is_running(orders_[*next].node)) {
      ++next;
      continue;
    }
    running_.push_back({*next, 0, canopen::SdoClient(orders_[*next].node, parameters_)});
    start(running_.back(), now);
    next = waiting_.erase(next);
  }
}

std::optional<canopen::Frame> SdoBatch::next_frame(HostTime now) {
  start_waiting(now);
  if (!closing_.empty()) {
    const canopen::Frame frame = closing_.front();
    closing_.pop_front();
    return frame;
  }
  for (Running& running : running_) {
    if (running.client.has_frame()) return running.client.next_frame(now);
  }
  return std::nullopt;
}

void SdoBatch::on_frame(const canopen::Frame& frame, HostTime now) {
  for (Running& running : running_) {
    if (frame.id == canopen::cob_id::sdo_response(running.client.node())) running.client.on_frame(frame, now);
  }
}

void SdoBatch::poll(HostTime now) {
  for (auto running = running_.begin(); running != running_.end();) {
    running->client.poll(now);
    running = end_of(*running, now) ? running_.erase(running) : running + 1;
  }
  start_waiting(now);
}

bool SdoBatch::end_of(Running& running, HostTime now) {
  if (running.client.busy()) return false;
  const auto result = running.client.take_result();
  if (!result) return false;
  const bool silent = is_silence(*result);
  if (silent && !orders_[running.order].data && running.attempts < kReadAttempts) {
    start(running, now);
    return false;
  }
  // The last frame of a transfer, an abort or a confirmation, still has to go; a bus may never take it.
  if (const auto last = running.client.next_frame(now)) closing_.push_back(*last);
  finish(running.order, *result);
  if (silent) give_up(*result);
  return true;
}

void SdoBatch::finish(std::size_t order, const canopen::SdoResult& result) {
  results_[order] = result;
  ++finished_;
}

void SdoBatch::give_up(const canopen::SdoResult& silent) {
  for (auto next = waiting_.begin(); next != waiting_.end();) {
    if (orders_[*next].node != silent.node) {
      ++next;
      continue;
    }
    canopen::SdoResult result = silent;
    result.address = orders_[*next].address;
    result.direction = orders_[*next].data ? canopen::SdoDirection::Download : canopen::SdoDirection::Upload;
    finish(*next, result);
    next = waiting_.erase(next);
  }
}

HostTime SdoBatch::next_deadline() const {
  HostTime next = kNever;
  for (const Running& running : running_) next = std::min(next, running.client.next_deadline());
  return next;
}

}  // namespace interpolated_motion::commissioning
