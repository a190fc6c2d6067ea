#include <functional>
#include <stdexcept>

#include <fmt/format.h>

#include "can_port.h"
#include "commands.h"
#include "interpolated_motion_driver/commissioning/monitor.h"
#include "line_port.h"
#include "open_drive.h"
#include "terminal.h"

namespace interpolated_motion::drive_tool {
namespace {

std::vector<std::uint8_t> numbers(const std::vector<int>& given, const char* option) {
  if (given.empty())
    throw std::invalid_argument(
        fmt::format("say which drives: {} N[,N...]; scan shows who is there", option));
  return {given.begin(), given.end()};
}

/// Shows what `look` returns, once or until the user has enough. `pause` lets time pass.
ExitCode show(const Options& options, const std::function<std::string()>& look,
              const std::function<void(HostDuration)>& pause) {
  do {
    const std::string text = look();
    options.once ? say(text) : show_page(text);
    if (!options.once) pause(host_duration(options.period));
  } while (!options.once);
  return Done;
}

}  // namespace

ExitCode monitor(const Options& options) {
  if (options.serial()) {
    const auto addresses = numbers(options.addresses, "--address");
    LinePort port(options, options.baud);
    commissioning::LineMonitor drives(port.session(), addresses);
    return show(
        options,
        [&] {
          return fmt::format("{}\nload of the line {:.1f} %", commissioning::monitor_table(drives.look()),
                             100 * port.session().master().load());
        },
        [&](HostDuration time) { port.session().listen(time); });
  }
  const auto nodes = numbers(options.nodes, "--node");
  CanPort port(options);
  refuse_beside_master(port, options);
  commissioning::CanMonitor drives(port.session(), nodes);
  return show(
      options,
      [&] {
        const std::string table = commissioning::monitor_table(drives.look());
        return fmt::format("{}\nload of the bus {:.1f} %", table,
                           100 * port.session().traffic().load(port.session().now()));
      },
      [&](HostDuration time) { port.session().listen(time); });
}

}  // namespace interpolated_motion::drive_tool
