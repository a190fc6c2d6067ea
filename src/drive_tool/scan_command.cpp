#include <fmt/format.h>

#include "can_port.h"
#include "commands.h"
#include "interpolated_motion_driver/commissioning/can_scan.h"
#include "interpolated_motion_driver/commissioning/line_scan.h"
#include "interpolated_motion_driver/hardware/bus_configuration.h"
#include "line_port.h"
#include "terminal.h"

namespace interpolated_motion::drive_tool {
namespace {

using commissioning::CanScan;
using commissioning::LineScan;

/// Below this all addresses take minutes, and no drive leaves the factory with it.
constexpr std::uint32_t kSlowest = 9600;

void say_all(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) say(text);
}

ExitCode scan_bus(const Options& options) {
  CanPort port(options);
  say(commissioning::describe_interface(port.interface()));
  ProgressLine line("asked for node ids:");
  const CanScan scan =
      commissioning::scan_can(port.session(), options.beside_master,
                              [&line](std::size_t done, std::size_t all) { line.show(done, all); });
  line.clear();
  bool good = !scan.devices.empty() && scan.asked;
  for (const auto& device : scan.devices) {
    say(commissioning::to_text(device));
    good = good && !device.twice;
  }
  say_all(commissioning::remarks(scan));
  if (scan.devices.empty() && scan.asked)
    say_all(
        commissioning::silent_bus_advice(port.interface(), port.errors(), port.session().traffic().frames()));
  say(fmt::format("{} of 127 node ids answer; load of the bus {:.1f} %", scan.devices.size(),
                  100 * port.session().traffic().load(port.session().now())));
  return good ? Done : Trouble;
}

LineScan scan_at(const Options& options, int baud) {
  LinePort port(options, baud);
  ProgressLine line(fmt::format("{} bit/s, asked for addresses:", baud));
  return commissioning::scan_line(port.session(),
                                  [&line](std::size_t done, std::size_t all) { line.show(done, all); });
}

/// The first of the other rates at which somebody answers, 0 where nobody does.
std::uint32_t rate_with_drives(const Options& options) {
  say(fmt::format("nobody answers at {} bit/s; trying the other rates", options.baud));
  for (const std::uint32_t rate : hardware::serial_rates()) {
    const int baud = static_cast<int>(rate);
    if (baud == options.baud || rate < kSlowest) continue;
    const LineScan scan = scan_at(options, baud);
    for (const auto& device : scan.devices) say(commissioning::to_text(device));
    if (!scan.devices.empty()) return rate;
  }
  return 0;
}

ExitCode scan_serial(const Options& options) {
  const LineScan scan = scan_at(options, options.baud);
  bool good = !scan.devices.empty();
  for (const auto& device : scan.devices) {
    say(commissioning::to_text(device));
    good = good && device.trouble.empty();
  }
  say_all(scan.remarks);
  if (scan.devices.empty()) {
    const std::uint32_t rate = rate_with_drives(options);
    say_all(
        commissioning::silent_line_advice(static_cast<std::uint32_t>(options.baud), scan.characters, rate));
  }
  say(fmt::format("{} of 254 addresses answer at {} bit/s", scan.devices.size(), options.baud));
  return good ? Done : Trouble;
}

}  // namespace

ExitCode scan(const Options& options) { return options.serial() ? scan_serial(options) : scan_bus(options); }

}  // namespace interpolated_motion::drive_tool
