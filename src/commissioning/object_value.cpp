#include "interpolated_motion_driver/commissioning/object_value.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/units/closest_name.h"

namespace interpolated_motion::commissioning {
namespace {

using canopen::DataType;
using canopen::ObjectAddress;

struct Unit {
  std::uint16_t index;
  const char* text;
};

// CiA 301 and CiA 402: the units of position, velocity and acceleration are the drive's own; EPOS2: qc, rpm
// (0x608B) and rpm/s.
constexpr Unit kUnits[] = {
    {0x1006, "us"},
    {0x100C, "ms"},
    {0x1013, "us"},
    {0x1016, "node << 16 | ms"},
    {0x1017, "ms"},
    {0x2062, "position units"},
    {0x20F4, "position units"},
    {0x6062, "position units"},
    {0x6064, "position units"},
    {0x6065, "position units"},
    {0x6067, "position units"},
    {0x6068, "ms"},
    {0x606B, "velocity units"},
    {0x606C, "velocity units"},
    {0x6078, "per mille of the rated current"},
    {0x6079, "mV"},
    {0x607A, "position units"},
    {0x607C, "position units"},
    {0x607D, "position units"},
    {0x607F, "velocity units"},
    {0x6081, "velocity units"},
    {0x6083, "acceleration units"},
    {0x6084, "acceleration units"},
    {0x6085, "acceleration units"},
    {0x60B1, "velocity units"},
    {0x60B2, "per mille of the rated torque"},
    {0x60C5, "acceleration units"},
    {0x60F4, "position units"},
    {0x60FF, "velocity units"},
};

std::optional<unsigned> hexadecimal(std::string text, unsigned most) {
  if (text.rfind("0x", 0) == 0 || text.rfind("0X", 0) == 0) text = text.substr(2);
  if (!text.empty() && (text.back() == 'h' || text.back() == 'H')) text.pop_back();
  if (text.empty() || text.size() > 4 ||
      text.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
    return std::nullopt;
  const unsigned long value = std::stoul(text, nullptr, 16);
  if (value > most) return std::nullopt;
  return static_cast<unsigned>(value);
}

/// "0x1018:4": index and sub-index are both hexadecimal, as they are written everywhere.
std::optional<ObjectAddress> parse_address(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto index = hexadecimal(text.substr(0, colon), 0xFFFF);
  const auto sub =
      colon == std::string::npos ? std::optional<unsigned>(0) : hexadecimal(text.substr(colon + 1), 0xFF);
  if (!index || !sub) return std::nullopt;
  return ObjectAddress{static_cast<std::uint16_t>(*index), static_cast<std::uint8_t>(*sub)};
}

std::string ambiguous(const std::string& text, const std::vector<const canopen::EdsObject*>& found) {
  std::string list;
  for (const canopen::EdsObject* object : found) {
    if (list.size() < 200)
      list += fmt::format("{}{} {}", list.empty() ? "" : ", ", canopen::to_string(object->address),
                          object->full_name());
  }
  return fmt::format("\"{}\" is the name of {} objects, take one of their numbers: {}", text, found.size(),
                     list);
}

Expected<NamedObject, std::string> find_by_name(const std::string& text, const canopen::Eds* eds) {
  if (eds == nullptr) {
    return fmt::format(
        "\"{}\" is no object's number, such as 0x6064 or 0x1018:4; names are looked up in an EDS: --eds FILE",
        text);
  }
  const auto found = eds->find(text);
  if (found.size() == 1)
    return NamedObject{found[0]->address, found[0]->full_name(), found[0]->type, found[0]};
  if (found.size() > 1) return ambiguous(text, found);
  std::vector<std::string> names;
  for (const auto& object : eds->objects) names.push_back(object.name);
  const std::string closest = closest_name(text, names);
  return fmt::format("the EDS has no object named \"{}\"{}", text,
                     closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest));
}

/// Of an integer type, both ends included; those of 8 bytes are cut to what an int64 can tell.
struct Bounds {
  std::int64_t low;
  std::int64_t high;
};

Bounds bounds_of(DataType type, std::size_t size) {
  const auto bits = static_cast<unsigned>(8 * std::min<std::size_t>(size, 8));
  const std::int64_t high = bits == 64 ? INT64_MAX : (std::int64_t{1} << bits) - 1;
  const std::int64_t middle = std::int64_t{1} << (bits - 1 < 62 ? bits - 1 : 62);
  if (type == DataType::Unknown) return {-middle, high};
  return canopen::is_signed(type) ? Bounds{-middle, middle - 1} : Bounds{0, high};
}

std::optional<std::int64_t> whole_number(const std::string& text) {
  try {
    std::size_t used = 0;
    const bool hexa = text.find("0x") != std::string::npos || text.find("0X") != std::string::npos;
    const std::int64_t value = std::stoll(text, &used, hexa ? 16 : 10);
    if (used == text.size()) return value;
  } catch (const std::exception&) {  // no number, or one that nothing holds
  }
  return std::nullopt;
}

}  // namespace

Expected<NamedObject, std::string> find_object(const std::string& text, const canopen::Eds* eds) {
  const auto address = parse_address(text);
  if (!address) return find_by_name(text, eds);
  NamedObject object;
  object.address = *address;
  object.name = cia402::epos_object_name(*address);
  if (eds == nullptr) return object;
  object.eds = eds->find(*address);
  if (object.eds == nullptr) return object;
  object.name = object.eds->full_name();
  object.type = object.eds->type;
  return object;
}

std::string unit_of(ObjectAddress address) {
  const auto* found = std::find_if(std::begin(kUnits), std::end(kUnits),
                                   [address](const Unit& unit) { return unit.index == address.index; });
  const bool count_of_entries = address.index == 0x1016 || address.index == 0x607D;
  if (found == std::end(kUnits) || (count_of_entries && address.subindex == 0)) return "";
  return found->text;
}

std::string title(const NamedObject& object) {
  return canopen::to_string(object.address) + (object.name.empty() ? "" : " " + object.name);
}

std::string plain_value(const canopen::SdoResult& result, DataType type) {
  if (type == DataType::VisibleString || result.data.size() > 8) return result.as_text();
  return canopen::is_signed(type) ? std::to_string(result.as_i64()) : std::to_string(result.as_u64());
}

std::string value_text(const canopen::SdoResult& result, DataType type) {
  if (type == DataType::VisibleString || result.data.size() > 8)
    return fmt::format("\"{}\"", result.as_text());
  if (canopen::is_signed(type)) return std::to_string(result.as_i64());
  return fmt::format("{} (0x{:0{}X})", result.as_u64(), result.as_u64(), 2 * result.data.size());
}

std::string facts_text(const NamedObject& object) {
  if (object.eds == nullptr) return "";
  const canopen::EdsObject& eds = *object.eds;
  const char* access = eds.constant                                     ? "const"
                       : eds.access == canopen::ObjectAccess::ReadOnly  ? "ro"
                       : eds.access == canopen::ObjectAccess::WriteOnly ? "wo"
                                                                        : "rw";
  std::string text = fmt::format("{}, {}", canopen::to_text(eds.type), access);
  if (eds.default_value) text += fmt::format(", default {}", *eds.default_value);
  if (eds.low && eds.high) text += fmt::format(", range {}..{}", *eds.low, *eds.high);
  return text;
}

Expected<std::vector<std::uint8_t>, std::string> value_bytes(const std::string& text,
                                                             const NamedObject& object, std::size_t size) {
  const DataType type = object.type;
  if (type == DataType::VisibleString || size > 8) return std::vector<std::uint8_t>(text.begin(), text.end());
  if (const std::size_t known = canopen::size_of(type)) size = known;
  if (size == 0) return fmt::format("{} has no bytes that are known", title(object));
  Bounds bounds = bounds_of(type, size);
  if (object.eds != nullptr) {
    bounds.low = std::max(bounds.low, object.eds->low.value_or(bounds.low));
    bounds.high = std::min(bounds.high, object.eds->high.value_or(bounds.high));
  }
  const auto value = whole_number(text);
  if (!value || *value < bounds.low || *value > bounds.high) {
    return fmt::format("{}: \"{}\" is {}; allowed: a whole number within {}..{}", title(object), text,
                       value ? "out of range" : "no number", bounds.low, bounds.high);
  }
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(*value) >> (8 * i));
  return bytes;
}

}  // namespace interpolated_motion::commissioning
