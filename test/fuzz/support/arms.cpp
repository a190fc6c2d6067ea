#include "fuzz/support/arms.h"

#include <fmt/format.h>

namespace interpolated_motion::fuzz {
namespace {

std::string drive_of(char kind, std::size_t number) {
  const std::string common = "counts_per_revolution: 2000, gear_ratio: 100, limits: {max_acceleration: 20}";
  if (kind == 's')
    return fmt::format("{{bus: line0, type: silverlode_ims, address: {}, {}}}", 15 + number, common);
  return fmt::format("{{bus: can0, type: {}, node_id: {}, {}}}", kind == 'c' ? "cyclic" : "epos_ipm", number,
                     common);
}

}  // namespace

std::string arm_of(const std::string& kinds) {
  std::string joints;
  std::string drives;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    joints += fmt::format("{}joint{}", i == 0 ? "" : ", ", i + 1);
    drives += fmt::format("  joint{}: {}\n", i + 1, drive_of(kinds[i], i + 1));
  }
  std::string buses;
  if (kinds.find_first_of("ec") != std::string::npos)
    buses += "  can0: {type: canopen, transport: emulated}\n";
  if (kinds.find('s') != std::string::npos) buses += "  line0: {type: silverlode, transport: emulated}\n";
  return fmt::format("joints: [{}]\nbring_up_timeout: 1.0\nsetpoints: {{linger: 0.1}}\nbuses:\n{}drives:\n{}",
                     joints, buses, drives);
}

}  // namespace interpolated_motion::fuzz
