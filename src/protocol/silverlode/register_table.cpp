#include "interpolated_motion_driver/protocol/silverlode/register_table.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "interpolated_motion_driver/units/closest_name.h"

namespace interpolated_motion::silverlode {
namespace {

constexpr RegisterFacts kFacts[] = {
    {0, "target_position", "counts", false, false},
    {1, "actual_position", "counts", false, false},
    {2, "index_position", "counts", false, false},
    {4, "stop_position", "counts", false, false},
    {6, "position_error", "counts in the low word", false, false},
    {7, "velocity", "1/32767 of 4000 rpm in each word", false, false},
    {9, "torque", "in the low word", false, false},
    {10, "accumulator", "", true, false},
    {17, "ims_control", "", true, true},
    {18, "ims_ticks_left", "servo ticks", false, false},
    {19, "ims_deceleration", "2000 rpm per tick / 2^31", true, true},
    {20, "profile_position", "counts", true, false},
    {21, "profile_acceleration", "4000 rpm per tick / 2^31", true, false},
    {22, "profile_velocity", "4000 rpm / 2^31", true, false},
    {23, "profile_deceleration", "4000 rpm per tick / 2^31", true, false},
    {24, "profile_offset", "counts", true, true},
    {39, "soft_stop_lower", "counts", true, true},
    {40, "soft_stop_upper", "counts", true, true},
};

/// 0..9 belong to the drive; those above 10 that have no meaning of their own are the user's.
constexpr std::uint16_t kFirstUser = 11;

bool is_number(const std::string& text) {
  return !text.empty() && text.size() <= 3 && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

RegisterFacts register_facts(std::uint16_t number) {
  const auto* found = std::find_if(std::begin(kFacts), std::end(kFacts),
                                   [number](const RegisterFacts& f) { return f.number == number; });
  if (found != std::end(kFacts)) return *found;
  const bool of_user = number >= kFirstUser;
  return {number, "", "", of_user, of_user};
}

std::optional<std::uint16_t> find_register(const std::string& text) {
  if (is_number(text)) {
    const int number = std::stoi(text);
    if (number > kLastRegister) return std::nullopt;
    return static_cast<std::uint16_t>(number);
  }
  const auto* found = std::find_if(std::begin(kFacts), std::end(kFacts),
                                   [&text](const RegisterFacts& f) { return text == f.name; });
  if (found == std::end(kFacts)) return std::nullopt;
  return found->number;
}

std::string closest_register(const std::string& text) {
  std::vector<std::string> names;
  for (const RegisterFacts& facts : kFacts) names.emplace_back(facts.name);
  return closest_name(text, names);
}

}  // namespace interpolated_motion::silverlode
