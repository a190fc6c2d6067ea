#include "interpolated_motion_driver/emulation/bus_faults.h"

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/transport/can_frame_text.h"
#include "interpolated_motion_driver/transport/stranger.h"

namespace interpolated_motion::emulation {
namespace {

constexpr int kHostPort = 0;
constexpr FaultNumber kIdentifier{"ID", 0.0, 0x7FF};

void drop_frames(transport::VirtualCanBus& bus, std::uint32_t id, int count) {
  bus.drop_if(
      [id, left = count](const canopen::Frame& frame) mutable { return frame.id == id && left-- > 0; });
}

std::optional<std::string> send_frame(transport::VirtualCanBus& bus, const std::string& text, HostTime now) {
  const auto frame = transport::parse_frame(text);
  if (!frame) {
    return "\"" + text + "\" is no CAN frame; it must be as candump writes it: 080#, 000#8002, 203#R";
  }
  if (bus.stranger().send(*frame, now)) return std::nullopt;
  return "too many frames wait to be sent already";
}

}  // namespace

std::vector<FaultCommand> faults_of(transport::VirtualCanBus& bus, HostTime now) {
  using Numbers = FaultCommand::Numbers;
  return {{"drop", {kFaultCount}, [&bus](const Numbers& n) { bus.drop_next(static_cast<int>(n[0])); }},
          {"drop_id",
           {kIdentifier, kFaultCount},
           [&bus](const Numbers& n) {
             drop_frames(bus, static_cast<std::uint32_t>(n[0]), static_cast<int>(n[1]));
           }},
          {"drop_nth", {kFaultCount}, [&bus](const Numbers& n) { bus.drop_nth(static_cast<int>(n[0])); }},
          {"refuse_nth", {kFaultCount}, [&bus](const Numbers& n) { bus.refuse_nth(static_cast<int>(n[0])); }},
          {"disconnect",
           {kFaultSwitch},
           [&bus, now](const Numbers& n) { bus.connect(kHostPort, n[0] == 0.0, now); }},
          {"bus_off",
           {kFaultSeconds},
           [&bus, now](const Numbers& n) { bus.host_bus_off(now + host_duration(n[0])); }},
          {"repeat_id",
           {kIdentifier, kFaultCount},
           [&bus](const Numbers& n) {
             bus.stranger().repeat(static_cast<std::uint32_t>(n[0]), static_cast<int>(n[1]));
           }},
          {"send", {}, {}, [&bus, now](const std::string& text) { return send_frame(bus, text, now); }}};
}

std::vector<FaultCommand> faults_of(transport::VirtualSerialLine& line, HostTime now) {
  using transport::SerialDirection;
  using Numbers = FaultCommand::Numbers;
  const auto lose = [&line](SerialDirection direction) {
    return [&line, direction](const Numbers& n) { line.lose_next(direction, static_cast<int>(n[0])); };
  };
  const auto garble = [&line](SerialDirection direction) {
    return [&line, direction](const Numbers& n) { line.garble_next(direction, static_cast<int>(n[0])); };
  };
  const auto lose_text = [&line](SerialDirection direction) {
    return [&line, direction](const Numbers& n) { line.lose_text(direction, static_cast<int>(n[0])); };
  };
  const auto garbage = [&line, now](const std::string& text) {
    line.inject(SerialDirection::DriveToHost, text, now);
    return std::optional<std::string>();
  };
  return {
      {"lose_requests", {kFaultCount}, lose(SerialDirection::HostToDrive)},
      {"lose_replies", {kFaultCount}, lose(SerialDirection::DriveToHost)},
      {"garble_requests", {kFaultCount}, garble(SerialDirection::HostToDrive)},
      {"garble_replies", {kFaultCount}, garble(SerialDirection::DriveToHost)},
      {"lose_request", {kFaultCount}, lose_text(SerialDirection::HostToDrive)},
      {"lose_reply", {kFaultCount}, lose_text(SerialDirection::DriveToHost)},
      {"refuse_nth", {kFaultCount}, [&line](const Numbers& n) { line.refuse_nth(static_cast<int>(n[0])); }},
      {"garbage", {}, {}, garbage},
      {"disconnect", {kFaultSwitch}, [&line, now](const Numbers& n) {
         line.connect(kHostPort, n[0] == 0.0, now);
       }}};
}

}  // namespace interpolated_motion::emulation
