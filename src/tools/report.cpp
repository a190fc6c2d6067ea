#include "report.h"

#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::tools {
namespace {

/// `count`: what one is, in `unit`.
std::string counts(double value, double count, const std::string& unit) {
  return std::isnan(value) ? "unknown" : fmt::format("{:.3f} counts ({:.2g} {})", value, value * count, unit);
}

}  // namespace

std::string report_text(const interpolated_motion_driver::GetMotionReport::Response& report) {
  if (!report.valid) return report.message + "\n";
  std::string text;
  for (std::size_t i = 0; i < report.name.size(); ++i) {
    text += fmt::format(
        "{}  bus {}  records sent {}  refused {}  worst deviation {}  final deviation {}  buffer minimum {}  "
        "underruns {}\n",
        report.name[i], report.bus[i], report.records_sent[i], report.refused_writes[i],
        counts(report.worst_deviation[i], report.count[i], report.unit[i]),
        counts(report.final_deviation[i], report.count[i], report.unit[i]), report.minimum_fill[i],
        report.underruns[i]);
  }
  for (std::size_t i = 0; i < report.bus_name.size(); ++i) {
    text += fmt::format("bus {}  peak load {:.1f} %\n", report.bus_name[i], 100.0 * report.peak_bus_load[i]);
  }
  return text;
}

}  // namespace interpolated_motion::tools
