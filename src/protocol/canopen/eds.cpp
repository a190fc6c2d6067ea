#include "interpolated_motion_driver/protocol/canopen/eds.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::canopen {
namespace {

/// Keys in lower case; CiA 306: neither sections nor keys depend on the case.
using Section = std::map<std::string, std::string>;
using Sections = std::map<std::string, Section>;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

Sections read_sections(const std::string& text) {
  Sections sections;
  Section* current = nullptr;
  std::istringstream stream(text);
  int number = 0;
  for (std::string raw; std::getline(stream, raw);) {
    ++number;
    const std::string line = trimmed(raw);
    if (line.empty() || line[0] == ';') continue;
    if (line[0] == '[' && line.back() == ']') {
      current = &sections[lower(line.substr(1, line.size() - 2))];
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || current == nullptr) {
      throw std::invalid_argument(
          fmt::format("line {} is \"{}\"; an EDS (CiA 306) has [SECTION] and KEY=VALUE", number, line));
    }
    (*current)[lower(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
  }
  return sections;
}

/// One section, to be asked for its keys.
class Reader {
 public:
  Reader(std::string name, const Section& section, std::uint8_t node)
      : name_(std::move(name)), section_(section), node_(node) {}

  std::string text(const std::string& key) const {
    const auto found = section_.find(key);
    return found == section_.end() ? "" : found->second;
  }

  /// Decimal, octal or hexadecimal; "$NODEID+" before it or "+$NODEID" behind it adds the node id.
  std::optional<std::int64_t> number(const std::string& key) const {
    std::string value = lower(text(key));
    if (value.empty()) return std::nullopt;
    const bool plus_node = take_node_id(value);
    try {
      std::size_t used = 0;
      const bool negative = value[0] == '-';
      const auto bits = std::stoull(negative ? value.substr(1) : value, &used, 0);
      if (used + (negative ? 1 : 0) != value.size()) throw std::invalid_argument(value);
      const auto signed_bits = static_cast<std::int64_t>(bits);
      return (negative ? -signed_bits : signed_bits) + (plus_node ? node_ : 0);
    } catch (const std::exception&) {
      throw std::invalid_argument(fmt::format(
          "[{}] {} is \"{}\"; it must be a whole number, such as 100 or 0x64", name_, key, text(key)));
    }
  }

 private:
  static bool take_node_id(std::string& value) {
    const std::string word = "$nodeid";
    const std::size_t at = value.find(word);
    if (at == std::string::npos) return false;
    value.erase(at, word.size());
    value.erase(std::remove(value.begin(), value.end(), '+'), value.end());
    value = trimmed(value);
    if (value.empty()) value = "0";
    return true;
  }

  std::string name_;
  const Section& section_;
  std::uint8_t node_;
};

/// A number of the type's width is read with the type's sign: an EDS may write 0xFFFF for -1.
std::optional<std::int64_t> in_type(std::optional<std::int64_t> value, DataType type) {
  const std::size_t size = size_of(type);
  if (!value || !is_signed(type) || size == 0) return value;
  return sign_extend(static_cast<std::uint64_t>(*value), static_cast<unsigned>(8 * size));
}

bool known_type(std::int64_t number) { return size_of(static_cast<DataType>(number)) > 0 || number == 0x09; }

EdsObject read_object(const Reader& reader, ObjectAddress address) {
  EdsObject object;
  object.address = address;
  object.name = reader.text("parametername");
  const std::int64_t type = reader.number("datatype").value_or(0);
  if (known_type(type)) object.type = static_cast<DataType>(type);
  const std::string access = lower(reader.text("accesstype"));
  object.constant = access == "const";
  if (access.rfind("rw", 0) == 0) object.access = ObjectAccess::ReadWrite;
  if (access == "wo") object.access = ObjectAccess::WriteOnly;
  if (object.type == DataType::VisibleString || object.type == DataType::Unknown) return object;
  object.default_value = in_type(reader.number("defaultvalue"), object.type);
  object.low = in_type(reader.number("lowlimit"), object.type);
  object.high = in_type(reader.number("highlimit"), object.type);
  return object;
}

/// Of a section such as "6064" or "1018sub1"; nothing for others.
std::optional<ObjectAddress> address_of(const std::string& section) {
  const std::size_t sub = section.find("sub");
  const std::string index = section.substr(0, sub);
  const std::string rest = sub == std::string::npos ? "0" : section.substr(sub + 3);
  const auto hexadecimal = [](const std::string& text, std::size_t most) {
    return !text.empty() && text.size() <= most &&
           text.find_first_not_of("0123456789abcdef") == std::string::npos;
  };
  if (index.size() != 4 || !hexadecimal(index, 4) || !hexadecimal(rest, 2)) return std::nullopt;
  return ObjectAddress{static_cast<std::uint16_t>(std::stoul(index, nullptr, 16)),
                       static_cast<std::uint8_t>(std::stoul(rest, nullptr, 16))};
}

/// CompactSubObj: an array whose entries are all alike and have no sections of their own.
void add_compact(const Reader& reader, ObjectAddress address, std::int64_t entries,
                 std::vector<EdsObject>& objects) {
  EdsObject count;
  count.address = address;
  count.name = "Highest Sub-index";
  count.parent = reader.text("parametername");
  count.type = DataType::Unsigned8;
  objects.push_back(count);
  for (std::int64_t entry = 1; entry <= std::min<std::int64_t>(entries, 254); ++entry) {
    EdsObject object = read_object(reader, {address.index, static_cast<std::uint8_t>(entry)});
    object.parent = count.parent;
    object.name = fmt::format("{} {}", count.parent, entry);
    objects.push_back(object);
  }
}

void add_section(const std::string& name, const Sections& sections, std::uint8_t node,
                 std::vector<EdsObject>& objects) {
  const auto address = address_of(name);
  if (!address) return;
  const Reader reader(name, sections.at(name), node);
  const bool entry = name.find("sub") != std::string::npos;
  const std::int64_t compact = entry ? 0 : reader.number("compactsubobj").value_or(0);
  if (compact > 0) return add_compact(reader, *address, compact, objects);
  // The head of an array or a record is no object of its own.
  if (reader.text("datatype").empty()) return;
  objects.push_back(read_object(reader, *address));
  const auto head = sections.find(name.substr(0, 4));
  if (entry && head != sections.end())
    objects.back().parent = Reader(name, head->second, node).text("parametername");
}

std::optional<std::uint32_t> number32(const Reader& reader, const std::string& key) {
  const auto value = reader.number(key);
  if (!value) return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

}  // namespace

const EdsObject* Eds::find(ObjectAddress address) const {
  const auto found = std::lower_bound(objects.begin(), objects.end(), address,
                                      [](const EdsObject& o, ObjectAddress a) { return o.address < a; });
  return found != objects.end() && found->address == address ? &*found : nullptr;
}

std::vector<const EdsObject*> Eds::find(const std::string& name) const {
  std::vector<const EdsObject*> found;
  const std::string wanted = lower(name);
  for (const EdsObject& object : objects) {
    if (lower(object.name) == wanted || lower(object.full_name()) == wanted) found.push_back(&object);
  }
  return found;
}

Eds parse_eds(const std::string& text, std::uint8_t node) {
  if (text.size() > kLongestEds)
    throw std::invalid_argument(fmt::format("{} characters; at most {} are read", text.size(), kLongestEds));
  const Sections sections = read_sections(text);
  Eds eds;
  if (const auto info = sections.find("deviceinfo"); info != sections.end()) {
    const Reader reader("DeviceInfo", info->second, node);
    eds.product_name = reader.text("productname");
    eds.vendor = number32(reader, "vendornumber");
    eds.product = number32(reader, "productnumber");
  }
  for (const auto& [name, section] : sections) add_section(name, sections, node, eds.objects);
  std::sort(eds.objects.begin(), eds.objects.end(),
            [](const EdsObject& a, const EdsObject& b) { return a.address < b.address; });
  if (eds.objects.empty())
    throw std::invalid_argument("it describes no object; an EDS (CiA 306) has sections such as [6064]");
  return eds;
}

}  // namespace interpolated_motion::canopen
