#include "interpolated_motion_driver/commissioning/bus_traffic.h"

#include <fmt/format.h>

namespace interpolated_motion::commissioning {
namespace {

using canopen::Service;

/// So many kinds of frames of another master are named.
constexpr int kNamed = 4;

bool is_command(Service service) {
  switch (service) {
    case Service::Nmt:
    case Service::Sync:
    case Service::Time:
    case Service::Rpdo:
    case Service::SdoRequest:
      return true;
    default:
      return false;
  }
}

}  // namespace

void BusTraffic::on_sending(const canopen::Frame& frame) {
  const canopen::CobIdMeaning meaning = canopen::classify(frame.id);
  if (meaning.service == Service::SdoRequest) nodes_[meaning.node].sdo_answers.on_request(frame);
}

void BusTraffic::on_frame(const canopen::ReceivedFrame& received) {
  load_.add(received.frame, received.time);
  if (received.own) return;
  ++frames_;
  if (received.frame.extended || received.frame.remote) return;
  const canopen::CobIdMeaning meaning = canopen::classify(received.frame.id);
  if (is_command(meaning.service)) ++commands_[received.frame.id];
  if (meaning.node != 0) on_node_frame(meaning, received);
}

void BusTraffic::on_node_frame(const canopen::CobIdMeaning& meaning, const canopen::ReceivedFrame& received) {
  NodeTraffic& node = nodes_[meaning.node];
  switch (meaning.service) {
    case Service::SdoRequest:
      return node.sdo_answers.on_request(received.frame);
    case Service::SdoResponse:
      node.sdo_answers.on_answer(received.frame);
      break;
    case Service::Heartbeat:
      if (const auto state = canopen::decode_heartbeat(received.frame)) node.state = state;
      break;
    case Service::Emcy:
      if (const auto emergency = canopen::decode_emcy(received.frame, received.time))
        node.emergency = emergency;
      break;
    case Service::Tpdo:
      break;
    default:
      return;
  }
  ++node.frames;
}

std::string BusTraffic::master_text() const {
  std::string text;
  int named = 0;
  for (const auto& [id, count] : commands_) {
    if (++named > kNamed) return text + ", and others";
    text += fmt::format("{}{} ({} frame{})", text.empty() ? "" : ", ", canopen::describe_cob_id(id), count,
                        count == 1 ? "" : "s");
  }
  return text;
}

}  // namespace interpolated_motion::commissioning
