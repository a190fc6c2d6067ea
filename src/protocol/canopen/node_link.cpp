#include "interpolated_motion_driver/protocol/canopen/node_link.h"

#include <fmt/format.h>

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/master.h"

namespace interpolated_motion::canopen {
namespace {

std::optional<Frame> rpdo_frame(std::uint8_t node, int n, const std::uint8_t* data, std::uint8_t length) {
  if (!valid_pdo_number(n) || length > 8) return std::nullopt;
  Frame frame;
  frame.id = cob_id::rpdo(n, node);
  frame.length = length;
  std::copy_n(data, length, frame.data.begin());
  return frame;
}

}  // namespace

NodeLink::NodeLink(Master& master, std::uint8_t id)
    : master_(master),
      id_(id),
      sdo_(id, master.parameters().sdo),
      heartbeat_(master.parameters().heartbeat_timeout),
      emergencies_(master.parameters().emcy_capacity),
      records_(master.parameters().bulk_capacity) {}

std::string NodeLink::name() const { return fmt::format("{} node {}", master_.bus_name(), id_); }

bool NodeLink::send_nmt(NmtCommand command) { return master_.send_nmt(command, id_); }

bool NodeLink::send_rpdo(int n, const std::uint8_t* data, std::uint8_t length) {
  const auto frame = rpdo_frame(id_, n, data, length);
  return frame && master_.queue_control(*frame);
}

bool NodeLink::send_record(int n, const std::uint8_t* data, std::uint8_t length) {
  const auto frame = rpdo_frame(id_, n, data, length);
  return frame && records_.push(*frame);
}

}  // namespace interpolated_motion::canopen
