#include "interpolated_motion_driver/protocol/cia402/buffer_status.h"

#include <fmt/format.h>

namespace interpolated_motion::cia402 {
namespace {

struct BitName {
  unsigned bit;
  const char* name;
};

// Errors before warnings: the text's beginning tells what matters.
constexpr BitName kNames[] = {
    {8, "underflow error"},   {9, "overflow error"},   {10, "velocity error"},  {11, "acceleration error"},
    {0, "underflow warning"}, {1, "overflow warning"}, {2, "velocity warning"}, {3, "acceleration warning"},
    {14, "buffer enabled"},   {15, "ip mode active"},
};

}  // namespace

std::string BufferStatus::text() const {
  std::string text;
  for (const BitName& entry : kNames) {
    if (!bit(entry.bit)) continue;
    if (!text.empty()) text += ", ";
    text += entry.name;
  }
  return fmt::format("{} (0x{:04X})", text.empty() ? "buffer disabled" : text, raw);
}

}  // namespace interpolated_motion::cia402
