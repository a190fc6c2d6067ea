#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/line_session.h"
#include "interpolated_motion_driver/commissioning/progress.h"

namespace interpolated_motion::commissioning {

/// What a SilverLode drive says it is. Empty is what it does not tell: it has no serial number to read.
struct LineDevice {
  std::uint8_t address = 0;                      ///< 1..254
  std::optional<std::uint16_t> revision;         ///< RVN, its first word; its form is not documented
  std::optional<std::uint16_t> internal_status;  ///< RIS
  std::optional<std::int32_t> position;          ///< register 1, counts
  std::string trouble;  ///< of its answers, in a sentence: two drives share the address
};

struct LineScan {
  std::vector<LineDevice> devices;   ///< that have answered, by address
  std::uint64_t characters = 0;      ///< heard altogether
  std::vector<std::string> remarks;  ///< on the line as a whole: noise, late replies, another host
};

/// Asks all addresses, 1..254, for their revision (RVN), and who answers for its status and position (RIS,
/// RRG 1): nothing is written, and no status is cleared.
LineScan scan_line(LineSession& session, const Progress& progress = {});

/// A drive in some lines, as `drive_tool scan` shows it.
std::string to_text(const LineDevice& device);

/// Sentences on a line on which nobody has answered at `baud`, which of `others` had drives (0: none of
/// them).
std::vector<std::string> silent_line_advice(std::uint32_t baud, std::uint64_t characters,
                                            std::uint32_t found_at);

}  // namespace interpolated_motion::commissioning
