#include "interpolated_motion_driver/axis/epos/bring_up.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cia402/position_limits.h"
#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/axis/cia402/value_origin.h"
#include "interpolated_motion_driver/axis/epos/host_watch.h"
#include "interpolated_motion_driver/axis/epos/telemetry.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/cia402/interpolation_data_record.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::sdo_write;
using canopen::SdoResult;
using sdo_steps::Step;
using sdo_steps::Steps;
using Failure = std::optional<std::string>;

namespace {

using namespace sdo_steps;

constexpr int kFinestVelocityNotation = -3;

// Identity.

Step read_vendor(EposFacts& facts) {
  return SdoSequence::read(object::kVendorId, [&facts](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    facts.identity.vendor = r.as_u32();
    if (facts.identity.is_maxon()) return std::nullopt;
    return fmt::format(
        "the device is not a maxon drive: vendor id 0x1018:01 is 0x{:08X}, maxon's is 0x{:08X}", r.as_u32(),
        cia402::kMaxonVendorId);
  });
}

// What the driver relies on.

/// Without these objects a drive has no Interpolated Position Mode, and is refused by its name.
Step require_interpolation_object(canopen::ObjectAddress address, EposFacts& facts) {
  return SdoSequence::read(address, [&facts](const SdoResult& r) -> Failure {
    if (r.ok) return std::nullopt;
    if (r.abort_code != canopen::abort_code::kNoObject) return r.text();
    return fmt::format(
        "{} has no Interpolated Position Mode (object {} does not exist; EPOS4 has none up to firmware "
        "0x0170). "
        "Use an EPOS2, or another drive type in the configuration",
        cia402::describe_identity(facts.identity), canopen::to_string(r.address));
  });
}

Step read_capacity(EposFacts& facts) {
  return SdoSequence::read(object::kMaximumBufferSize, [&facts](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    facts.capacity = r.as_u32();
    if (facts.capacity >= 4 && facts.capacity <= cia402::kFifoRecords) return std::nullopt;
    return fmt::format("the FIFO's size 0x60C4:01 is {}, it must be within 4..{}", facts.capacity,
                       cia402::kFifoRecords);
  });
}

Steps verification(EposFacts& facts) {
  return {read_device_type(),
          read_vendor(facts),
          read_u32(object::kProductCode, facts.identity.product),
          read_u32(object::kRevisionNumber, facts.identity.revision),
          read_u32(object::kSerialNumber, facts.identity.serial),
          require_interpolation_object(object::kInterpolationSubMode, facts),
          require_interpolation_object(object::kMaximumBufferSize, facts),
          require_interpolation_object(object::kBufferStatus, facts),
          read_capacity(facts),
          require_mode(cia402::Mode::InterpolatedPosition),
          require_value(object::kInterpolationSubMode, cia402::kCubicSplineSubMode,
                        "interpolation sub mode, -1 is PVT"),
          require_value(object::kInterpolationPeriod, 1, "interpolation period in ms"),
          require_value(object::kInterpolationTimeIndex, -3, "interpolation time index"),
          require_value(object::kPositionNotation, 0, "position notation"),
          require_value(object::kPositionDimension, cia402::kPositionDimensionQc,
                        "position dimension, 0xAC is qc"),
          require_value(object::kVelocityDimension, cia402::kVelocityDimensionRpm,
                        "velocity dimension, 0xA4 is rpm"),
          require_value(object::kAccelerationNotation, 0, "acceleration notation"),
          require_value(object::kAccelerationDimension, cia402::kVelocityDimensionRpm,
                        "acceleration dimension, 0xA4 is rpm/s")};
}

// Limits and units.

struct VelocityUnitSearch {
  const EposAxisParameters& parameters;
  SdoSequence& sequence;
  EposFacts& facts;
};

Steps try_velocity_notation(VelocityUnitSearch search, int notation);

std::uint32_t velocity_limit(const VelocityUnitSearch& search, int notation) {
  const double rpm = motor_limits(search.parameters).velocity * search.parameters.limit_margin;
  return to_u32(rpm * std::pow(10.0, -notation));
}

std::string velocity_origin(const EposAxisParameters& parameters) {
  return origin_of(parameters, "limits/max_velocity", parameters.limits.max_velocity) +
         fmt::format(", {:.0f} rpm of the motor, and limit_margin", motor_limits(parameters).velocity);
}

/// The drive did not take a unit, or not the limits in it: the next coarser one is tried.
Failure try_coarser(VelocityUnitSearch search, int notation, const SdoResult& refused) {
  if (!refused.aborted_by_drive) return refused.text();
  if (notation == 0)
    return refused.text() + "; the drive does not take what follows from " +
           velocity_origin(search.parameters);
  search.sequence.insert(try_velocity_notation(search, notation + 1));
  return std::nullopt;
}

Step write_velocity_limit(VelocityUnitSearch search, int notation) {
  const auto limit = sdo_write<std::uint32_t>(object::kMaxProfileVelocity, velocity_limit(search, notation));
  return SdoSequence::write(limit, [search, notation](const SdoResult& r) -> Failure {
    if (!r.ok) return try_coarser(search, notation, r);
    search.facts.velocity_notation = notation;
    search.facts.max_velocity = velocity_limit(search, notation);
    const double warn = motor_limits(search.parameters).velocity * std::pow(10.0, -notation);
    search.sequence.insert(
        {because_of(write_u32(object::kProfileVelocity, to_u32(warn)), velocity_origin(search.parameters))});
    return std::nullopt;
  });
}

/// The finest velocity unit keeps the rounding of the records' velocities out of the path: an error dv of a
/// knot's velocity moves a cubic piece of length h by up to h dv / 4.
Steps try_velocity_notation(VelocityUnitSearch search, int notation) {
  if (velocity_limit(search, notation) > static_cast<std::uint32_t>(cia402::kMaxRecordVelocity) &&
      notation < 0) {
    return try_velocity_notation(search, notation + 1);
  }
  const auto unit = sdo_write<std::int8_t>(object::kVelocityNotation, static_cast<std::int8_t>(notation));
  return {SdoSequence::write(unit, [search, notation](const SdoResult& r) -> Failure {
    if (!r.ok) return try_coarser(search, notation, r);
    search.sequence.insert({write_velocity_limit(search, notation)});
    return std::nullopt;
  })};
}

Steps motion_limits(const EposAxisParameters& parameters, EposFacts& facts) {
  const std::uint32_t acceleration = to_u32(motor_limits(parameters).acceleration);
  facts.max_acceleration = to_u32(motor_limits(parameters).acceleration * parameters.limit_margin);
  const std::string origin =
      origin_of(parameters, "limits/max_acceleration", parameters.limits.max_acceleration) +
      fmt::format(", {:.0f} rpm/s of the motor", motor_limits(parameters).acceleration);
  return {
      because_of(write_u32(object::kMaxAcceleration, facts.max_acceleration), origin + ", and limit_margin"),
      because_of(write_u32(object::kProfileAcceleration, acceleration), origin),
      because_of(write_u32(object::kProfileDeceleration, acceleration), origin),
      because_of(write_u32(object::kQuickStopDeceleration, acceleration), origin)};
}

Steps supervision(const EposAxisParameters& parameters) {
  const auto ms = [](HostDuration d) {
    return std::chrono::duration_cast<std::chrono::milliseconds>(d).count();
  };
  const double counts =
      std::abs(parameters.transmission.counts_per_radian()) * parameters.max_following_error;
  return {SdoSequence::write(sdo_write<std::uint16_t>(
              object::kProducerHeartbeat, static_cast<std::uint16_t>(ms(parameters.heartbeat_period)))),
          watch_host_at_rest(parameters),
          SdoSequence::write(
              sdo_write<std::int16_t>(object::kAbortConnectionOption, parameters.abort_connection_option)),
          SdoSequence::write(
              sdo_write<std::int16_t>(object::kFaultReactionOption, parameters.fault_reaction_option)),
          because_of(write_u32(object::kMaxFollowingError, to_u32(counts)),
                     origin_of(parameters, "max_following_error", parameters.max_following_error))};
}

// PDOs.

/// 0x60C4:02 can be mapped by maxon's application note, cannot by its EDS, and is mapped by robots that run:
/// tried, and read by SDO where the drive refuses. Must be the last steps of the sequence.
Steps buffer_pdo(std::uint8_t node, SdoSequence& sequence, EposFacts& facts) {
  facts.free_records_mapped = true;
  Steps steps = pdo(epos_pdo::buffer_tpdo(true), node);
  for (Step& step : steps) {
    if (step.write->value != cia402::pdo_entry::kFreeRecords.value()) continue;
    step.check = [node, &sequence, &facts](const SdoResult& r) -> Failure {
      if (r.ok) return std::nullopt;
      if (!r.aborted_by_drive) return r.text();
      facts.free_records_mapped = false;
      sequence.replace_rest(pdo(epos_pdo::buffer_tpdo(false), node));
      return std::nullopt;
    };
  }
  return steps;
}

constexpr canopen::ObjectAddress kTimeStampCobId{0x1400 + epos_pdo::kTimeStampRpdo - 1, 1};
constexpr canopen::ObjectAddress kTimeStampMapping{0x1600 + epos_pdo::kTimeStampRpdo - 1, 1};

struct TimeStampSetup {
  std::uint8_t node;
  std::vector<canopen::SdoWrite> writes;
  SdoSequence& sequence;
  EposFacts& facts;
};

/// The clock of a drive that takes no time stamps is estimated: that is no reason to refuse the drive.
Failure without_time_stamps(const TimeStampSetup& setup, const std::string& reason) {
  setup.facts.time_stamp_refusal = reason;
  setup.sequence.insert(
      writes({canopen::pdo_disable(canopen::PdoDirection::Rpdo, epos_pdo::kTimeStampRpdo, setup.node)}));
  return std::nullopt;
}

/// Goes on with `next` after a success, without time stamps after an abort by the drive.
template <class Next>
SdoSequence::Check unless_refused(TimeStampSetup setup, Next next) {
  return [setup = std::move(setup), next](const SdoResult& r) -> Failure {
    if (!r.ok) return r.aborted_by_drive ? without_time_stamps(setup, r.text()) : r.text();
    return next(setup, r);
  };
}

/// What the drive says it has mapped counts, not only that it took it.
Step verify_time_stamps(const TimeStampSetup& setup) {
  const auto verify = [](const TimeStampSetup& s, const SdoResult& r) -> Failure {
    s.facts.takes_time_stamps = r.as_u32() == cia402::pdo_entry::kTimeStamp.value();
    if (s.facts.takes_time_stamps) return std::nullopt;
    return without_time_stamps(s, fmt::format("0x{:08X} is mapped in the place of 0x1013", r.as_u32()));
  };
  return SdoSequence::read(kTimeStampMapping, unless_refused(setup, verify));
}

Step time_stamp_write(const TimeStampSetup& setup, std::size_t index) {
  const auto go_on = [index](const TimeStampSetup& s, const SdoResult&) -> Failure {
    const bool more = index + 1 < s.writes.size();
    s.sequence.insert({more ? time_stamp_write(s, index + 1) : verify_time_stamps(s)});
    return std::nullopt;
  };
  return SdoSequence::write(setup.writes[index], unless_refused(setup, go_on));
}

/// Bits 0 to 29 of a COB-ID must not change while its PDO is valid (CiA 301, 1400h), and which one the drive
/// has is left from an earlier life of the host: it is invalidated as it is.
Step time_stamp_setup(const TimeStampSetup& setup) {
  const auto invalidate = [](const TimeStampSetup& s, const SdoResult& r) -> Failure {
    TimeStampSetup longer = s;
    const auto off = sdo_write<std::uint32_t>(kTimeStampCobId, r.as_u32() | canopen::kPdoInvalid);
    longer.writes.insert(longer.writes.begin(), off);
    s.sequence.insert({time_stamp_write(longer, 0)});
    return std::nullopt;
  };
  return SdoSequence::read(kTimeStampCobId, unless_refused(setup, invalidate));
}

Steps time_stamps(const EposAxisParameters& parameters, std::uint8_t node, SdoSequence& sequence,
                  EposFacts& facts) {
  if (!parameters.clock_discipline) {
    return writes({canopen::pdo_disable(canopen::PdoDirection::Rpdo, epos_pdo::kTimeStampRpdo, node)});
  }
  const auto configuration = epos_pdo::time_stamp_rpdo(parameters.host_node_id);
  return {time_stamp_setup({node, canopen::pdo_configuration(configuration, node), sequence, facts})};
}

Steps pdos(const EposAxisParameters& parameters, std::uint8_t node, SdoSequence& sequence, EposFacts& facts) {
  Steps steps = pdo(epos_pdo::record_rpdo(), node);
  append(steps, pdo(epos_pdo::controlword_rpdo(), node));
  append(steps, time_stamps(parameters, node, sequence, facts));
  append(steps, writes({canopen::pdo_disable(canopen::PdoDirection::Rpdo, 4, node)}));
  append(steps, pdo(epos_pdo::status_tpdo(), node));
  append(steps, pdo(epos_pdo::motion_tpdo(), node));
  append(steps, pdo(epos_pdo::demand_tpdo(), node));
  append(steps, buffer_pdo(node, sequence, facts));
  return steps;
}

}  // namespace

double EposFacts::velocity_unit_rpm() const { return std::pow(10.0, velocity_notation); }

MotorLimits motor_limits(const EposAxisParameters& parameters) {
  const auto& transmission = parameters.transmission;
  return {std::abs(transmission.motor_rpm(parameters.limits.max_velocity)),
          std::abs(transmission.motor_rpm(parameters.limits.max_acceleration))};
}

std::vector<SdoSequence::Step> epos_position_limit_steps(const EposAxisParameters& parameters,
                                                         std::optional<double> present) {
  Steps steps = writes(position_limits(parameters.limits, parameters.transmission, present));
  for (Step& step : steps) step = because_of(std::move(step), position_limits_origin(parameters));
  return steps;
}

std::vector<SdoSequence::Step> epos_bring_up_steps(const EposAxisParameters& parameters, std::uint8_t node,
                                                   SdoSequence& sequence, EposFacts& facts) {
  Steps steps = verification(facts);
  append(steps, supervision(parameters));
  append(steps, try_velocity_notation({parameters, sequence, facts}, kFinestVelocityNotation));
  append(steps, motion_limits(parameters, facts));
  append(steps, epos_position_limit_steps(parameters, std::nullopt));
  append(steps, pdos(parameters, node, sequence, facts));
  return steps;
}

}  // namespace interpolated_motion::axis
