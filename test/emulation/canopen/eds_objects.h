#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "eds_file.h"
#include "interpolated_motion_driver/emulation/canopen/object_entry.h"

namespace interpolated_motion::emulation {

using Key = std::pair<unsigned, unsigned>;

// Bits of a type number of CiA 301; 0 for strings.
inline int bits_of(unsigned type) {
  switch (type) {
    case 2:
    case 5:
      return 8;
    case 3:
    case 6:
      return 16;
    case 4:
    case 7:
      return 32;
    case 0x1B:
      return 64;
    default:
      return 0;
  }
}

inline std::int64_t number(std::string text, unsigned type) {
  std::int64_t value = 0;
  if (text.rfind("$nodeid+", 0) == 0) text = text.substr(8);
  if (!text.empty()) value = std::stoll(text, nullptr, 0);
  const int bits = bits_of(type);
  if (type <= 4 && value >= (std::int64_t{1} << (bits - 1))) value -= std::int64_t{1} << bits;
  return value;
}

inline std::map<Key, std::map<std::string, std::string>> objects_of(const EdsFile& file) {
  std::map<Key, std::map<std::string, std::string>> objects;
  for (const auto& [section, keys] : file) {
    if (section.find_first_not_of("0123456789abcdefsu") != std::string::npos || keys.count("datatype") == 0)
      continue;
    const std::size_t sub = section.find("sub");
    const auto index = static_cast<unsigned>(std::stoul(section.substr(0, 4), nullptr, 16));
    const auto subindex = sub == std::string::npos
                              ? 0U
                              : static_cast<unsigned>(std::stoul(section.substr(sub + 3), nullptr, 16));
    objects[{index, subindex}] = keys;
  }
  return objects;
}

inline std::string access_text(Access access) {
  switch (access) {
    case Access::Ro:
      return "ro";
    case Access::Wo:
      return "wo";
    case Access::Rw:
      return "rw";
    case Access::Rww:
      return "rww";
    case Access::Const:
      return "const";
  }
  return "";
}

}  // namespace interpolated_motion::emulation
