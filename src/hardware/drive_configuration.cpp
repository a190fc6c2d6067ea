#include "interpolated_motion_driver/hardware/drive_configuration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/emulation/limits.h"
#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::hardware {

namespace {

using trajectory::in_unit;
using trajectory::JointUnit;
using trajectory::Quantity;
using trajectory::symbol;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Without a limit of its own a joint may reach its velocity limit within this time.
constexpr double kDefaultAccelerationTime = 0.1;
/// A joint at its limit may read as much beyond it, in counts: rounding, and what a drive's demand may be off
/// where it rests. The drives' own limits (0x607D) leave as much room.
constexpr double kPositionSlackInCounts = 2.0;

/// A limit of the configuration may tighten that of the URDF, never widen it. `unit`: of both.
double tightened(ParameterReader& reader, const std::string& key, double urdf, bool upper, const char* unit) {
  const double value = reader.number(key, urdf, -kInfinity, kInfinity);
  const bool wider = upper ? value > urdf : value < urdf;
  if (wider) {
    reader.fail(
        key, fmt::format("is {0} {2}; the URDF allows {1} {2} and may only be tightened", value, urdf, unit));
  }
  return value;
}

/// Many URDFs say 0 where nobody has thought of a limit: there is none then.
double parse_velocity_limit(ParameterReader& reader, double urdf, JointUnit unit) {
  if (!reader.has("max_velocity") && urdf <= 0.0) {
    reader.fail("max_velocity",
                fmt::format("is missing, and the URDF says {}: it must be a finite number above 0. Give "
                            "the joint a velocity limit in the URDF or here",
                            urdf));
  }
  const double bound = urdf > 0.0 ? urdf : std::numeric_limits<double>::infinity();
  const double velocity = tightened(reader, "max_velocity", bound, true, symbol(unit, Quantity::Velocity));
  if (velocity > 0.0 && std::isfinite(velocity)) return velocity;
  reader.fail("max_velocity",
              fmt::format("is {}; it must be a finite number above 0: give the joint a velocity limit in "
                          "the URDF or here",
                          velocity));
}

trajectory::JointLimits parse_limits(const std::string& joint, ParameterReader reader,
                                     const UrdfLimits& urdf) {
  const auto found = urdf.find(joint);
  if (found == urdf.end()) {
    reader.fail(
        "",
        fmt::format(
            "belongs to joint \"{}\", which the URDF does not have. Correct the name, or add the joint to "
            "the robot description",
            joint));
  }
  trajectory::JointLimits limits = found->second;
  const char* unit = symbol(limits.unit);
  limits.min_position = tightened(reader, "min_position", limits.min_position, false, unit);
  limits.max_position = tightened(reader, "max_position", limits.max_position, true, unit);
  limits.max_velocity = parse_velocity_limit(reader, limits.max_velocity, limits.unit);
  if (limits.min_position > limits.max_position) {
    reader.fail("min_position",
                fmt::format("is {}, above max_position {}", limits.min_position, limits.max_position));
  }
  limits.max_acceleration =
      reader.number("max_acceleration", limits.max_velocity / kDefaultAccelerationTime, 1e-6, 1e9);
  reader.refuse_unknown();
  return limits;
}

constexpr const char* kGearRatio = "gear_ratio";
constexpr const char* kTravel = "travel_per_revolution";

/// Of a joint whose positions are lengths: revolutions per revolution mean nothing.
double parse_travel(ParameterReader& reader) {
  reader.ignore(kTravel);
  const char* what =
      "m of the joint per revolution of the motor (the lead of the screw, or the circumference of the "
      "pulley, "
      "divided by the gear between it and the motor)";
  if (reader.has(kGearRatio)) {
    reader.fail(
        kGearRatio,
        fmt::format("is not for this joint, which is prismatic in the URDF: leave it out, and give {}, {}",
                    kTravel, what));
  }
  if (!reader.has(kTravel))
    reader.fail(kTravel, fmt::format("is missing: the joint is prismatic in the URDF; give {}", what));
  return encoding::Transmission::ratio_of_travel(reader.required_number(kTravel, 1e-9, 1e3));
}

double parse_gear_ratio(ParameterReader& reader) {
  if (reader.has(kTravel)) {
    reader.fail(
        kTravel,
        fmt::format("is for prismatic joints, and this one turns by the URDF: leave it out, and give "
                    "{}, revolutions of the motor per revolution of the joint, or correct the type of "
                    "the joint in the URDF",
                    kGearRatio));
  }
  return reader.number(kGearRatio, 1.0, 1e-6, 1e6);
}

encoding::Transmission parse_transmission(ParameterReader& reader, JointUnit unit) {
  encoding::Transmission transmission;
  transmission.counts_per_revolution = reader.required_number("counts_per_revolution", 1.0, 1e8);
  transmission.ratio = unit == JointUnit::Metre ? parse_travel(reader) : parse_gear_ratio(reader);
  transmission.direction = static_cast<int>(reader.integer("direction", 1, -1, 1));
  if (transmission.direction == 0) reader.fail("direction", "is 0; allowed: 1, -1");
  transmission.offset = reader.number("offset", 0.0, -1e6, 1e6);
  return transmission;
}

const DriveKind* parse_kind(ParameterReader& reader, const DriveKinds& kinds) {
  std::vector<std::pair<std::string, const DriveKind*>> choices;
  for (const DriveKind* kind : kinds) choices.emplace_back(kind->name(), kind);
  return reader.choice("type", kinds.front(), choices);
}

void require_representable(const ParameterReader& reader, const std::string& key, double position,
                           double counts) {
  if (std::abs(counts) <= std::numeric_limits<std::int32_t>::max()) return;
  reader.fail(key, fmt::format("is {}, which is {:.0f} counts of the encoder; a drive counts up to +-{}",
                               position, counts, std::numeric_limits<std::int32_t>::max()));
}

/// What the encoder of an emulated drive reads with the joint at 0 and at 1 (rad or m).
Mechanism parse_mechanism(ParameterReader& reader, const encoding::Transmission& transmission) {
  constexpr double kMost = 1e12;
  const char* at_0 = "counts_at_0";
  const char* at_1 = "counts_at_1";
  if (!reader.has(at_0) && !reader.has(at_1)) {
    reader.ignore(at_0);
    reader.ignore(at_1);
    return {transmission.counts_per_radian(), transmission.offset};
  }
  const double first = reader.required_number(at_0, -kMost, kMost);
  const double second = reader.required_number(at_1, -kMost, kMost);
  if (first == second)
    reader.fail(at_1, fmt::format("is {}, as {}: the encoder must move with the joint", second, at_0));
  return {second - first, first / (first - second)};
}

/// Positions that the joint may have must have a number of counts.
void check_reach(const ParameterReader& reader, const DriveConfiguration& drive) {
  if (drive.limits.continuous) return;
  for (const auto& [key, position] : {std::pair("limits/min_position", drive.limits.min_position),
                                      std::pair("limits/max_position", drive.limits.max_position)}) {
    if (std::isfinite(position))
      require_representable(reader, key, position, drive.transmission.counts(position));
  }
}

DriveEmulation parse_emulation(ParameterReader& reader, const encoding::Transmission& transmission) {
  using emulation::kLargestClockError;
  DriveEmulation emulation;
  emulation.missing = reader.boolean("missing", emulation.missing);
  emulation.mechanism = parse_mechanism(reader, transmission);
  const double position = reader.number("initial_position", 0.0, -1e6, 1e6);
  const double counts = std::round(emulation.mechanism.counts(position));
  require_representable(reader, "initial_position", position, counts);
  emulation.initial_position = static_cast<std::int32_t>(counts);
  emulation.clock_error_ppm = reader.number("clock_error_ppm", 0.0, -kLargestClockError, kLargestClockError);
  return emulation;
}

/// What only drives of this kind have.
void parse_settings(ParameterReader& reader, DriveConfiguration& drive) {
  ParameterReader emulation = reader.map("emulation");
  drive.emulation = parse_emulation(emulation, drive.transmission);
  drive.settings = drive.kind->parse(reader, emulation, drive);
  emulation.refuse_unknown();
}

}  // namespace

DriveConfiguration parse_drive(const std::string& joint, ParameterReader reader, const UrdfLimits& urdf,
                               const DriveKinds& kinds) {
  DriveConfiguration drive;
  drive.joint = joint;
  drive.bus = reader.required_name("bus");
  drive.kind = parse_kind(reader, kinds);
  drive.limits = parse_limits(joint, reader.map("limits"), urdf);
  drive.transmission = parse_transmission(reader, drive.limits.unit);
  drive.limits.position_slack = std::max(
      drive.limits.position_slack, kPositionSlackInCounts / std::abs(drive.transmission.counts_per_radian()));
  check_reach(reader, drive);
  drive.deviation_bound =
      reader.number("deviation_bound", drive.kind->default_deviation_bound(), 0.6, 1000.0);
  drive.max_following_error =
      reader.number("max_following_error", in_unit(drive.limits.unit, drive.max_following_error), 1e-6, 1e3);
  drive.limit_margin = reader.number("limit_margin", drive.limit_margin, 1.0, 10.0);
  drive.plan_margin =
      reader.number("plan_margin", std::min(drive.plan_margin, drive.limit_margin), 1.0, drive.limit_margin);
  drive.limits.rate_slack = drive.plan_margin - 1.0;
  const DriveNumbers& numbers = drive_numbers(drive.kind->bus_type());
  drive.number = static_cast<int>(reader.required_integer(numbers.key, 1, numbers.highest));
  parse_settings(reader, drive);
  reader.refuse_unknown();
  return drive;
}

}  // namespace interpolated_motion::hardware
