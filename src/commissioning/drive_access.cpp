#include "interpolated_motion_driver/commissioning/drive_access.h"

#include <fmt/format.h>

namespace interpolated_motion::commissioning {

std::string Change::text() const {
  return fmt::format("{}: {} -> {}{}", title, before.value, after, unit.empty() ? "" : " " + unit);
}

}  // namespace interpolated_motion::commissioning
