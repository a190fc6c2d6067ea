#include "open_drive.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/command_line/input_file.h"
#include "interpolated_motion_driver/commissioning/can_drive.h"
#include "interpolated_motion_driver/commissioning/line_drive.h"
#include "interpolated_motion_driver/protocol/canopen/eds.h"

namespace interpolated_motion::drive_tool {
namespace {

/// A driver sends SYNC and heartbeats at least that often.
constexpr HostDuration kListen = std::chrono::milliseconds(300);

std::uint8_t only(const std::vector<int>& numbers, const char* option, const char* range) {
  if (numbers.size() == 1) return static_cast<std::uint8_t>(numbers.front());
  throw std::invalid_argument(fmt::format("say which drive, one of them: {} {}", option, range));
}

std::optional<canopen::Eds> read_eds(const Options& options, std::uint8_t node) {
  if (options.eds.empty()) return std::nullopt;
  const std::string text = command_line::read_text_file(options.eds);
  try {
    return canopen::parse_eds(text, node);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", options.eds, error.what()));
  }
}

}  // namespace

OpenDrive::OpenDrive(const Options& options) {
  if (options.serial()) {
    const std::uint8_t address = only(options.addresses, "--address", "1..254");
    line_ = std::make_unique<LinePort>(options, options.baud);
    drive_ = std::make_unique<commissioning::LineDrive>(line_->session(), address);
    return;
  }
  const std::uint8_t node = only(options.nodes, "--node", "1..127");
  auto eds = read_eds(options, node);
  can_ = std::make_unique<CanPort>(options);
  refuse_beside_master(*can_, options);
  drive_ = std::make_unique<commissioning::CanDrive>(can_->session(), node, std::move(eds));
}

void refuse_beside_master(CanPort& port, const Options& options) {
  if (options.beside_master) return;
  port.session().listen(kListen);
  if (!port.session().traffic().other_master()) return;
  throw std::runtime_error(
      fmt::format("another master is on {}, perhaps the driver node: {}. Transfers of both would spoil each "
                  "other: stop it, or "
                  "give --beside-master",
                  options.place, port.session().traffic().master_text()));
}

}  // namespace interpolated_motion::drive_tool
