#include "interpolated_motion_driver/commissioning/line_drive.h"

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/silverlode/nak.h"
#include "interpolated_motion_driver/protocol/silverlode/register_table.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/protocol/silverlode/status_words.h"

namespace interpolated_motion::commissioning {
namespace {

using silverlode::Outcome;
using silverlode::OutcomeKind;
using silverlode::RegisterFacts;

constexpr const char* kType = "INTEGER32";

std::string title(const RegisterFacts& facts) {
  return fmt::format("register {}{}{}", facts.number, *facts.name != '\0' ? " " : "", facts.name);
}

std::string failure_of(const Outcome& outcome, const std::string& what, std::uint8_t address) {
  if (outcome.kind == OutcomeKind::Refused) {
    return fmt::format("{}: the drive at address {} refuses it: NAK {} ({})", what, address,
                       static_cast<int>(outcome.nak), silverlode::to_text(outcome.nak));
  }
  if (outcome.kind == OutcomeKind::Garbled) {
    return fmt::format("{}: the answer of address {} is garbled: \"{}\"", what, address,
                       outcome.received.printable());
  }
  return fmt::format(
      "{}: address {} does not answer. Check its power, its address, the cable and --baud; scan shows who is "
      "there",
      what, address);
}

Expected<std::uint16_t, std::string> register_of(const std::string& name) {
  if (const auto number = silverlode::find_register(name)) return *number;
  const std::string closest = silverlode::closest_register(name);
  return fmt::format("\"{}\" is no register: they have numbers 0..255{}", name,
                     closest.empty() ? ", some of them names such as actual_position"
                                     : fmt::format("; did you mean {}?", closest));
}

Expected<std::int32_t, std::string> value_of(const std::string& text, const std::string& what) {
  try {
    std::size_t used = 0;
    const bool hexadecimal = text.find("0x") != std::string::npos;
    const long long value = std::stoll(text, &used, hexadecimal ? 16 : 10);
    if (used == text.size() && value >= INT32_MIN && value <= INT32_MAX)
      return static_cast<std::int32_t>(value);
  } catch (const std::exception&) {  // no number, or one that nothing holds
  }
  return fmt::format("{}: \"{}\" is no whole number within -2147483648..2147483647", what, text);
}

Parameter parameter_of(const RegisterFacts& facts, std::int32_t value) {
  return {std::to_string(facts.number), kType, std::to_string(value), facts.name};
}

}  // namespace

DriveAccess::Result<DriveIdentity> LineDrive::identity() {
  const Outcome outcome = session_.ask(silverlode::rvn_request(address_));
  if (outcome.unknown()) return failure_of(outcome, "revision (RVN)", address_);
  const auto revision = outcome.word();
  return DriveIdentity{{"kind", "silverlode"},
                       {"revision", revision ? std::to_string(*revision) : "none"},
                       {"address", std::to_string(address_)}};
}

DriveAccess::Result<std::int32_t> LineDrive::read(std::uint16_t number) {
  const Outcome outcome = session_.ask(silverlode::rrg_request(address_, number));
  if (const auto value = outcome.register_value()) return *value;
  return failure_of(outcome, title(silverlode::register_facts(number)), address_);
}

DriveAccess::Result<Shown> LineDrive::show(const std::string& name) {
  auto number = register_of(name);
  if (!number) return number.error();
  const RegisterFacts facts = silverlode::register_facts(number.value());
  auto value = read(facts.number);
  if (!value) return value.error();
  const auto bits = static_cast<std::uint32_t>(value.value());
  std::string text = fmt::format("{} = {} (0x{:08X})", title(facts), value.value(), bits);
  if (*facts.unit != '\0') text += fmt::format(" {}", facts.unit);
  text += fmt::format("  [{}, {}]", kType, facts.writable ? "rw" : "ro");
  return Shown{text};
}

DriveAccess::Result<Change> LineDrive::prepare(const std::string& name, const std::string& value) {
  auto number = register_of(name);
  if (!number) return number.error();
  const RegisterFacts facts = silverlode::register_facts(number.value());
  if (!facts.writable) return fmt::format("{} is read-only: it is a value of the drive", title(facts));
  auto after = value_of(value, title(facts));
  if (!after) return after.error();
  auto before = read(facts.number);
  if (!before) return before.error();
  return Change{title(facts), facts.unit, parameter_of(facts, before.value()), std::to_string(after.value())};
}

DriveAccess::Failure LineDrive::apply(const Change& change) {
  const auto number = static_cast<std::uint16_t>(std::stoi(change.before.number));
  const auto value = value_of(change.after, change.title);
  if (!value) return value.error();
  const Outcome outcome = session_.ask(silverlode::wri_request(address_, number, value.value()));
  if (!outcome.accepted()) return failure_of(outcome, change.title, address_);
  const auto after = read(number);
  if (!after) return after.error();
  if (after.value() == value.value()) return std::nullopt;
  return fmt::format("{}: the drive has taken the write, yet has {} now", change.title, after.value());
}

DriveAccess::Failure LineDrive::save() {
  return std::string(
      "a SilverLode drive keeps no registers without power: they belong into the program that it runs at "
      "power-up "
      "(QuickControl)");
}

DriveAccess::Result<std::vector<Parameter>> LineDrive::parameters(const Progress& progress) {
  std::vector<Parameter> parameters;
  for (std::uint16_t number = 0; number <= silverlode::kLastRegister; ++number) {
    const RegisterFacts facts = silverlode::register_facts(number);
    if (progress) progress(number + 1U, silverlode::kLastRegister + 1U);
    if (!facts.parameter) continue;
    const Outcome outcome = session_.ask(silverlode::rrg_request(address_, number));
    if (outcome.unknown()) return failure_of(outcome, title(facts), address_);
    if (const auto value = outcome.register_value()) parameters.push_back(parameter_of(facts, *value));
  }
  return parameters;
}

DriveAccess::Result<std::vector<Change>> LineDrive::differences(const std::vector<Parameter>& wanted,
                                                                const Progress& progress) {
  std::vector<Change> changes;
  std::size_t done = 0;
  for (const Parameter& parameter : wanted) {
    auto change = prepare(parameter.number, parameter.value);
    if (progress) progress(++done, wanted.size());
    if (!change) return change.error();
    if (change.value().before.value != change.value().after) changes.push_back(change.value());
  }
  return changes;
}

DriveAccess::Failure LineDrive::why_not_restore() {
  const Outcome outcome = session_.ask(silverlode::rio_request(address_));
  const auto word = outcome.word();
  if (!word || !silverlode::IoStatus{*word}.trajectory_active()) return std::nullopt;
  return fmt::format("the drive at address {} moves: its registers are restored at rest only", address_);
}

std::vector<std::string> LineDrive::restore(const std::vector<Parameter>&,
                                            const std::vector<Change>& changes) {
  std::vector<std::string> failures;
  for (const Change& change : changes)
    if (auto failure = apply(change)) failures.push_back(*failure);
  return failures;
}

}  // namespace interpolated_motion::commissioning
