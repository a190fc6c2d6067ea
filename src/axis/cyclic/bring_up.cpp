#include "interpolated_motion_driver/axis/cyclic/bring_up.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cia402/position_limits.h"
#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/axis/cia402/value_origin.h"
#include "interpolated_motion_driver/axis/cyclic/telemetry.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::sdo_write;
using sdo_steps::Steps;

namespace {

using namespace sdo_steps;

constexpr std::int8_t kMilliseconds = -3;  // 0x60C2:2, power of ten of a second

template <class Unit>
std::int64_t count(HostDuration d) {
  return std::chrono::duration_cast<Unit>(d).count();
}

Steps verification(cia402::Identity& identity) {
  return {read_device_type(),
          read_u32(object::kVendorId, identity.vendor),
          read_u32(object::kProductCode, identity.product),
          read_u32(object::kRevisionNumber, identity.revision),
          read_u32(object::kSerialNumber, identity.serial),
          require_mode(cia402::Mode::CyclicSynchronousPosition)};
}

Steps supervision(const CyclicAxisParameters& p) {
  using std::chrono::milliseconds;
  const auto consumer = static_cast<std::uint32_t>(p.host_node_id) << 16 |
                        static_cast<std::uint32_t>(count<milliseconds>(p.heartbeat_timeout));
  const auto producer = static_cast<std::uint16_t>(count<milliseconds>(p.heartbeat_period));
  const double window = std::abs(p.transmission.counts_per_radian()) * p.max_following_error;
  return {
      SdoSequence::write(sdo_write<std::uint16_t>(object::kProducerHeartbeat, producer)),
      write_u32(object::kConsumerHeartbeat1, consumer),
      write_if_present(sdo_write<std::int16_t>(object::kAbortConnectionOption, p.abort_connection_option)),
      write_if_present(sdo_write<std::int16_t>(object::kFaultReactionOption, p.fault_reaction_option)),
      because_of(write_u32(object::kMaxFollowingError, to_u32(window)),
                 origin_of(p, "max_following_error", p.max_following_error))};
}

Steps deceleration(const CyclicAxisParameters& p) {
  const double counts = std::abs(p.transmission.counts_per_second(p.limits.max_acceleration));
  const std::uint32_t units = to_u32(counts / p.acceleration_unit);
  const std::string origin =
      origin_of(p, "limits/max_acceleration", p.limits.max_acceleration) + " and acceleration_unit";
  return {
      because_of(write_if_present(sdo_write<std::uint32_t>(object::kProfileDeceleration, units)), origin),
      because_of(write_if_present(sdo_write<std::uint32_t>(object::kQuickStopDeceleration, units)), origin)};
}

Steps cycle(const CyclicAxisParameters& p) {
  const auto ms = static_cast<std::uint8_t>(count<std::chrono::milliseconds>(p.sync_period));
  const auto us = static_cast<std::uint32_t>(count<std::chrono::microseconds>(p.sync_period));
  const std::string origin = fmt::format("sync_period of the bus ({} ms)", ms);
  return {
      because_of(write_if_present(sdo_write<std::uint32_t>(object::kCommunicationCyclePeriod, us)), origin),
      because_of(SdoSequence::write(sdo_write<std::uint8_t>(object::kInterpolationPeriod, ms)), origin),
      because_of(SdoSequence::write(sdo_write<std::int8_t>(object::kInterpolationTimeIndex, kMilliseconds)),
                 origin)};
}

using canopen::pdo_disable;
using canopen::PdoDirection;

/// Steps that map `entry`, which a drive may lack or may not let be mapped: it goes on with `without` then.
Steps unless_refused(Steps steps, const canopen::PdoEntry& entry, bool& taken, SdoSequence& sequence,
                     const Steps& without) {
  taken = true;
  for (Step& step : steps) {
    if (!step.write || step.write->value != entry.value()) continue;
    step.check = [&taken, &sequence, without](const canopen::SdoResult& r) -> std::optional<std::string> {
      if (r.ok) return std::nullopt;
      if (!r.aborted_by_drive) return r.text();
      taken = false;
      sequence.replace_rest(without);
      return std::nullopt;
    };
  }
  return steps;
}

Steps no_torque_pdo(std::uint8_t node) {
  return sdo_steps::writes({pdo_disable(PdoDirection::Rpdo, cyclic_pdo::kTorqueRpdo, node)});
}

Steps torque_pdo(const CyclicAxisParameters& p, std::uint8_t node, SdoSequence& sequence,
                 CyclicFacts& facts) {
  facts.takes_torque = false;
  if (p.torque_per_acceleration == 0.0) return no_torque_pdo(node);
  return unless_refused(pdo(cyclic_pdo::torque_rpdo(), node), cia402::pdo_entry::kTorqueOffset,
                        facts.takes_torque, sequence, no_torque_pdo(node));
}

/// What goes to the drive before each SYNC. Must be the last steps of the sequence.
Steps target_pdos(const CyclicAxisParameters& p, std::uint8_t node, SdoSequence& sequence,
                  CyclicFacts& facts) {
  const Steps torque = torque_pdo(p, node, sequence, facts);
  Steps alone = pdo(cyclic_pdo::target_rpdo(false), node);
  append(alone, torque);
  facts.takes_velocity = false;
  if (!p.velocity_feedforward) return alone;
  Steps steps = unless_refused(pdo(cyclic_pdo::target_rpdo(true), node), cia402::pdo_entry::kVelocityOffset,
                               facts.takes_velocity, sequence, alone);
  append(steps, torque);
  return steps;
}

Steps pdos(const CyclicAxisParameters& p, std::uint8_t node, SdoSequence& sequence, CyclicFacts& facts) {
  Steps steps = pdo(cyclic_pdo::controlword_rpdo(), node);
  append(steps, pdo(cyclic_pdo::status_tpdo(), node));
  append(steps, pdo(cyclic_pdo::velocity_tpdo(p.sync_period), node));
  append(steps, pdo(cyclic_pdo::demand_tpdo(p.sync_period), node));
  append(steps, writes({pdo_disable(PdoDirection::Rpdo, 4, node), pdo_disable(PdoDirection::Tpdo, 4, node)}));
  append(steps, target_pdos(p, node, sequence, facts));
  return steps;
}

}  // namespace

std::vector<SdoSequence::Step> cyclic_position_limit_steps(const CyclicAxisParameters& parameters,
                                                           std::optional<double> present) {
  Steps steps;
  for (const canopen::SdoWrite& write : position_limits(parameters.limits, parameters.transmission, present))
    steps.push_back(because_of(write_if_present(write), position_limits_origin(parameters)));
  return steps;
}

std::vector<SdoSequence::Step> cyclic_bring_up_steps(const CyclicAxisParameters& parameters,
                                                     std::uint8_t node, cia402::Identity& identity,
                                                     SdoSequence& sequence, CyclicFacts& facts) {
  Steps steps = verification(identity);
  append(steps, supervision(parameters));
  append(steps, deceleration(parameters));
  append(steps, cyclic_position_limit_steps(parameters, std::nullopt));
  append(steps, cycle(parameters));
  append(steps, pdos(parameters, node, sequence, facts));
  return steps;
}

}  // namespace interpolated_motion::axis
