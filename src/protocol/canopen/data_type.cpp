#include "interpolated_motion_driver/protocol/canopen/data_type.h"

#include <algorithm>
#include <iterator>

namespace interpolated_motion::canopen {
namespace {

struct TypeFacts {
  DataType type;
  const char* name;
  std::size_t size;
  bool has_sign;
};

constexpr TypeFacts kFacts[] = {
    {DataType::Boolean, "BOOLEAN", 1, false},       {DataType::Integer8, "INTEGER8", 1, true},
    {DataType::Integer16, "INTEGER16", 2, true},    {DataType::Integer32, "INTEGER32", 4, true},
    {DataType::Integer64, "INTEGER64", 8, true},    {DataType::Unsigned8, "UNSIGNED8", 1, false},
    {DataType::Unsigned16, "UNSIGNED16", 2, false}, {DataType::Unsigned32, "UNSIGNED32", 4, false},
    {DataType::Unsigned64, "UNSIGNED64", 8, false}, {DataType::VisibleString, "VISIBLE_STRING", 0, false},
};

const TypeFacts* facts_of(DataType type) {
  const auto* found = std::find_if(std::begin(kFacts), std::end(kFacts),
                                   [type](const TypeFacts& f) { return f.type == type; });
  return found != std::end(kFacts) ? found : nullptr;
}

}  // namespace

std::string to_text(DataType type) {
  const TypeFacts* facts = facts_of(type);
  return facts != nullptr ? facts->name : "UNKNOWN";
}

DataType data_type(const std::string& name) {
  const auto* found = std::find_if(std::begin(kFacts), std::end(kFacts),
                                   [&name](const TypeFacts& f) { return name == f.name; });
  return found != std::end(kFacts) ? found->type : DataType::Unknown;
}

std::size_t size_of(DataType type) {
  const TypeFacts* facts = facts_of(type);
  return facts != nullptr ? facts->size : 0;
}

bool is_signed(DataType type) {
  const TypeFacts* facts = facts_of(type);
  return facts != nullptr && facts->has_sign;
}

DataType integer_type(std::size_t size, bool with_sign) {
  for (const TypeFacts& facts : kFacts) {
    const bool integer = facts.type != DataType::Boolean && facts.size > 0;
    if (integer && facts.size == size && facts.has_sign == with_sign) return facts.type;
  }
  return DataType::Unknown;
}

}  // namespace interpolated_motion::canopen
