#include "interpolated_motion_driver/axis/epos/fifo_loader.h"

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/epos/host_watch.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace object = cia402::object;
using canopen::sdo_write;
using canopen::SdoResult;

namespace {

/// Longest for the records of a prefill to get over the bus.
constexpr HostDuration kFillTimeout = 5s;
/// How often a FIFO is filled again when the drive holds another number of records than were sent.
constexpr int kAttempts = 3;

}  // namespace

SdoSequence::Step read_demand(std::int32_t& counts) {
  return SdoSequence::read(object::kPositionDemand,
                           [&counts](const SdoResult& r) -> std::optional<std::string> {
                             if (!r.ok) return r.text();
                             counts = r.as_i32();
                             return std::nullopt;
                           });
}

SdoSequence::Step close_fifo() {
  return SdoSequence::write(sdo_write<std::uint8_t>(object::kBufferClear, cia402::kBufferClearAndClose));
}

void FifoLoader::begin(HostTime now) {
  attempts_ = 0;
  clear(now);
}

void FifoLoader::clear(HostTime now) {
  ++attempts_;
  feed_.rewind();
  sender_.withdraw();
  enter(Step::Clearing, now);
  const auto open = sdo_write<std::uint8_t>(object::kBufferClear, cia402::kBufferOpen);
  stage_.sequence().start(
      {watch_host_in_motion(parameters_), close_fifo(), SdoSequence::write(open), read_demand(demand_)}, now);
}

void FifoLoader::enter(Step step, HostTime now) {
  step_ = step;
  stage_.time().begin(now);
}

bool FifoLoader::poll(HostTime now) {
  switch (step_) {
    case Step::Clearing:
      poll_clearing(now);
      return false;
    case Step::Filling:
      poll_filling(now);
      return false;
    case Step::Verifying:
      break;
  }
  return poll_verifying(now);
}

void FifoLoader::poll_clearing(HostTime now) {
  if (!stage_.sequence_done(now)) return;
  const std::int32_t expected = feed_.start_position();
  if (demand_ > expected + 1 || demand_ < expected - 1) {
    return stage_.fail(
        fmt::format(
            "its demand was {} counts when the goal was planned and is {} counts now: something else moves "
            "this drive",
            expected, demand_),
        now);
  }
  sender_.begin();
  enter(Step::Filling, now);
  sender_.send(now);
}

void FifoLoader::poll_filling(HostTime now) {
  if (stage_.time().expired(now, kFillTimeout))
    return stage_.fail("its records do not get onto the bus: is the bus overloaded or down?", now);
  if (!sender_.all_on_bus()) return;
  enter(Step::Verifying, now);
  const auto take = [this](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    held_ = r.as_u16();
    return std::nullopt;
  };
  stage_.sequence().start({SdoSequence::read(object::kUsedRecords, take)}, now);
}

bool FifoLoader::poll_verifying(HostTime now) {
  if (!stage_.sequence_done(now)) return false;
  const auto sent = static_cast<std::uint32_t>(feed_.sent());
  if (held_ == sent) {
    watch_.filled(held_);
    return true;
  }
  if (held_ < sent) watch_.note_lost(sent - held_);
  if (attempts_ < kAttempts) {
    clear(now);
  } else {
    stage_.fail(fmt::format("{} records were sent but its FIFO holds {} (0x60C4:04), {} times in a row: are "
                            "its PDOs still set up as at bring-up (0x1400, 0x1600)?",
                            sent, held_, kAttempts),
                now);
  }
  return false;
}

}  // namespace interpolated_motion::axis
