#include "interpolated_motion_driver/node/diagnostics.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/statusword.h"
#include "interpolated_motion_driver/protocol/silverlode/status_words.h"

namespace interpolated_motion::node {
namespace {

constexpr auto kOk = ::diagnostic_msgs::DiagnosticStatus::OK;
constexpr auto kWarn = ::diagnostic_msgs::DiagnosticStatus::WARN;
constexpr auto kError = ::diagnostic_msgs::DiagnosticStatus::ERROR;

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

void summarize_drive(const motion::JointSnapshot& joint, DiagnosticStatus& status) {
  if (!joint.online) {
    status.summary(kError, "the drive does not answer");
  } else if (joint.error_code != 0) {
    status.summary(kError, fmt::format("{}: 0x{:04X} {}", joint.state, joint.error_code, joint.error_text));
  } else if (joint.underruns > 0) {
    status.summary(kWarn, fmt::format("{}; the buffer has run dry {} times", joint.state, joint.underruns));
  } else if (joint.overflows > 0 || joint.refused_writes > 0) {
    status.summary(kWarn, fmt::format("{}; the drive did not take {} records", joint.state,
                                      joint.overflows + joint.refused_writes));
  } else {
    status.summary(kOk, joint.state);
  }
}

/// Hexadecimal, with the names of the bits that are set.
std::string statusword_text(std::uint16_t word, hardware::BusType bus) {
  return bus == hardware::BusType::Silverlode ? silverlode::PollingStatus{word}.text()
                                              : cia402::Statusword{word}.text();
}

/// Whether replies take half as long again as planned; a millisecond of it may be the host's scheduler.
bool is_late(const motion::ReplyDelay& delay) { return delay.mean > 1.5 * delay.planned + 0.001; }

void summarize_bus(const motion::BusSnapshot& bus, double max_load, DiagnosticStatus& status) {
  if (!bus.usable) {
    status.summary(kError, bus.state);
  } else if (bus.lost_frames > 0) {
    status.summary(kWarn, fmt::format("{} frames were lost", bus.lost_frames));
  } else if (bus.reply_delay && is_late(*bus.reply_delay)) {
    status.summary(kWarn,
                   fmt::format("replies take {:.1f} ms where {:.1f} ms are planned, so goals may be "
                               "accepted that the line cannot carry. Set buses/{}/turnaround to {:.3f}",
                               1e3 * bus.reply_delay->mean, 1e3 * bus.reply_delay->planned, bus.name,
                               bus.reply_delay->mean));
  } else if (bus.load > max_load) {
    status.summary(kWarn,
                   fmt::format("load {} is above the configured {}", percent(bus.load), percent(max_load)));
  } else {
    status.summary(kOk, fmt::format("load {}", percent(bus.load)));
  }
}

}  // namespace

void diagnose_group(const motion::Snapshot& snapshot, HostDuration longest_turn, DiagnosticStatus& status) {
  if (snapshot.state == motion::GroupState::Fault) {
    status.summary(kError, snapshot.fault);
  } else {
    status.summary(kOk, motion::to_string(snapshot.state));
  }
  status.add("longest turn of the bus thread", fmt::format("{:.1f} ms", 1e3 * seconds(longest_turn)));
}

void diagnose_drive(const motion::JointSnapshot& joint, hardware::BusType bus, DiagnosticStatus& status) {
  summarize_drive(joint, status);
  status.add("bus", joint.bus);
  status.add("state", joint.state);
  status.add("statusword", statusword_text(joint.statusword, bus));
  status.add("following error",
             fmt::format("{:.6f} {}", joint.following_error, trajectory::symbol(joint.unit)));
  status.add("buffered records", fmt::format("{} of {}", joint.fill, joint.capacity));
  status.add("buffered time", fmt::format("{:.3f} s", joint.fill_time));
  status.add("underruns", joint.underruns);
  status.add("overflows", joint.overflows);
  status.add("refused records", joint.refused_writes);
  const double error = joint.clock_error_ppm;
  status.add("clock error", std::isnan(error) ? "unknown" : fmt::format("{:.1f} ppm", error));
}

void diagnose_bus(const motion::BusSnapshot& bus, double max_load, DiagnosticStatus& status) {
  summarize_bus(bus, max_load, status);
  status.add("state", bus.state);
  status.add("load", percent(bus.load));
  status.add("frames sent", bus.frames_sent);
  status.add("frames received", bus.frames_received);
  status.add("unexpected frames", bus.unexpected);
  status.add("error frames", bus.error_frames);
  status.add("lost frames", bus.lost_frames);
  if (bus.reply_delay) {
    status.add("reply delay", fmt::format("{:.1f} ms", 1e3 * bus.reply_delay->mean));
    return;
  }
  status.add("SYNC delay", fmt::format("{:.3f} ms", bus.sync_delay * 1e3));
  status.add("SYNC jitter", fmt::format("{:.3f} ms", bus.sync_jitter * 1e3));
  status.add("SYNCs skipped", bus.syncs_skipped);
}

void diagnose_wire_log(const WireLog& log, DiagnosticStatus& status) {
  const std::uint64_t lost = log.lost();
  if (lost > 0) {
    status.summary(kWarn, fmt::format("{} frames are missing in {}", lost, log.path()));
  } else {
    status.summary(kOk, log.path());
  }
}

Diagnostics::Diagnostics(const ros::NodeHandle& node, const HardwareThread& hardware,
                         const hardware::Configuration& configuration, const WireLog* wire_log)
    : hardware_(hardware), updater_(node, node) {
  updater_.setHardwareID("none");
  updater_.add("group", [this](DiagnosticStatus& status) {
    diagnose_group(snapshot_, hardware_.longest_turn(), status);
  });
  for (const auto& bus : configuration.buses) add_bus(bus);
  for (const auto& drive : configuration.drives) add_drive(drive.joint, configuration.bus_of(drive).type);
  if (wire_log != nullptr) {
    updater_.add("wire log", [wire_log](DiagnosticStatus& status) { diagnose_wire_log(*wire_log, status); });
  }
}

void Diagnostics::add_drive(const std::string& joint, hardware::BusType bus) {
  updater_.add("drive " + joint, [this, joint, bus](DiagnosticStatus& status) {
    for (const auto& candidate : snapshot_.joints) {
      if (candidate.joint == joint) diagnose_drive(candidate, bus, status);
    }
  });
}

void Diagnostics::add_bus(const hardware::BusConfiguration& bus) {
  updater_.add("bus " + bus.name, [this, name = bus.name, max_load = bus.max_load](DiagnosticStatus& status) {
    for (const auto& candidate : snapshot_.buses) {
      if (candidate.name == name) diagnose_bus(candidate, max_load, status);
    }
  });
}

void Diagnostics::publish() {
  hardware_.snapshot(snapshot_);
  updater_.force_update();
}

}  // namespace interpolated_motion::node
