#include "interpolated_motion_driver/axis/cia402/sdo_stop.h"

#include <optional>
#include <string>
#include <utility>

#include "interpolated_motion_driver/protocol/cia402/objects.h"
#include "interpolated_motion_driver/protocol/cia402/statusword.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::SdoResult;
using Failure = std::optional<std::string>;

void SdoStop::begin() { running_ = written_ = round_after_ = read_after_ = false; }

void SdoStop::poll(std::uint16_t word, HostTime now) {
  if (running_ && sequence_.running()) return;
  if (std::exchange(running_, false)) take_round(now);
  const auto write = [this](const SdoResult& r) -> Failure {
    written_ = written_ || r.ok;
    return r.ok ? Failure() : r.text();
  };
  const auto look = [this, word, write](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    statusword_ = r.as_u16();
    if (!written_ && cia402::Statusword{statusword_}.state() == cia402::State::OperationEnabled)
      sequence_.insert(
          {SdoSequence::write(canopen::sdo_write<std::uint16_t>(object::kControlword, word), write)});
    return std::nullopt;
  };
  round_after_ = written_;
  running_ = true;
  const auto take_position = [this](const SdoResult& r) -> Failure {
    if (r.ok) position_ = r.as_i32();
    return r.ok ? Failure() : r.text();
  };
  sequence_.start({SdoSequence::read(object::kStatusword, look),
                   SdoSequence::read(object::kPositionActual, take_position)},
                  now);
}

void SdoStop::take_round(HostTime now) {
  if (sequence_.state() != SdoSequence::State::Done) return;
  read_after_ = round_after_;
  device_.report().statusword.raw = statusword_;
  device_.report().status_time = now;
  device_.take_position(position_, now);
}

bool SdoStop::halted() const { return read_after_ && cia402::Statusword{statusword_}.target_reached(); }

}  // namespace interpolated_motion::axis
