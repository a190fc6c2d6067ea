#pragma once

#include <string>

#include <interpolated_motion_driver/GetMotionReport.h>

namespace interpolated_motion::tools {

/// The report as a table: one line per joint, one per bus.
std::string report_text(const interpolated_motion_driver::GetMotionReport::Response& report);

}  // namespace interpolated_motion::tools
