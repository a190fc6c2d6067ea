#include "interpolated_motion_driver/protocol/canopen/cob_id.h"

#include <fmt/format.h>

namespace interpolated_motion::canopen {
namespace {

/// Function codes 3 to 10 (bits 7..10) alternate TPDO 1, RPDO 1, TPDO 2, ...
CobIdMeaning pdo_meaning(std::uint32_t function, std::uint8_t node) {
  const Service service = function % 2 == 1 ? Service::Tpdo : Service::Rpdo;
  return {service, node, static_cast<int>((function - 1) / 2)};
}

CobIdMeaning node_service(std::uint32_t function, std::uint8_t node) {
  if (function >= 3 && function <= 10) return pdo_meaning(function, node);
  switch (function) {
    case 1:
      return {Service::Emcy, node, 0};
    case 11:
      return {Service::SdoResponse, node, 0};
    case 12:
      return {Service::SdoRequest, node, 0};
    case 14:
      return {Service::Heartbeat, node, 0};
    default:
      return {};
  }
}

const char* name_of(Service service) {
  switch (service) {
    case Service::Nmt:
      return "NMT";
    case Service::Sync:
      return "SYNC";
    case Service::Emcy:
      return "EMCY";
    case Service::Time:
      return "TIME";
    case Service::Tpdo:
      return "TPDO";
    case Service::Rpdo:
      return "RPDO";
    case Service::SdoResponse:
      return "SDO response";
    case Service::SdoRequest:
      return "SDO request";
    case Service::Heartbeat:
      return "heartbeat";
    case Service::Lss:
      return "LSS";
    case Service::Unknown:
      break;
  }
  return "unknown COB-ID";
}

}  // namespace

CobIdMeaning classify(std::uint32_t id) {
  if (id == cob_id::kNmt) return {Service::Nmt, 0, 0};
  if (id == cob_id::kSync) return {Service::Sync, 0, 0};
  if (id == cob_id::kTime) return {Service::Time, 0, 0};
  if (id == cob_id::kLssResponse || id == cob_id::kLssRequest) return {Service::Lss, 0, 0};
  const auto node = static_cast<std::uint8_t>(id & 0x7F);
  if (node == 0 || id > 0x7FF) return {};
  return node_service(id >> 7, node);
}

std::string describe_cob_id(std::uint32_t id) {
  const CobIdMeaning meaning = classify(id);
  if (meaning.service == Service::Unknown) return fmt::format("unknown COB-ID 0x{:03X}", id);
  std::string text = name_of(meaning.service);
  if (meaning.pdo != 0) text += fmt::format(" {}", meaning.pdo);
  if (meaning.node != 0) text += fmt::format(" of node {}", meaning.node);
  return text;
}

}  // namespace interpolated_motion::canopen
