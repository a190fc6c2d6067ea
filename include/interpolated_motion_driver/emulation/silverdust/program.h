#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace interpolated_motion::emulation {

/// One line of a standalone program on the drive, as far as interpolated motion needs them.
struct ProgramStep {
  enum class Kind {
    WriteRegister,       ///< WRP: register `target` := `value`
    CopyRegisters,       ///< `count` registers from `value` on go to `target` on
    StartInterpolation,  ///< IMS
    WaitSegmentTaken,    ///< until the high word of register 17 is not 0
  };

  Kind kind = Kind::WaitSegmentTaken;  ///< decides which of the rest mean anything
  std::int64_t target = 0;             ///< number of the first register written
  std::int32_t value = 0;  ///< that is written; of CopyRegisters the number of the first register read
  std::int64_t count = 0;  ///< registers, of CopyRegisters only

  /// The lines of a program. A register that cannot be written sets bit 12 (command error) of the polling
  /// status word, one that does not exist reads 0.
  static ProgramStep write(std::int64_t reg, std::int32_t value) {
    return {Kind::WriteRegister, reg, value, 0};
  }
  static ProgramStep copy(std::int32_t from, std::int64_t to, std::int64_t count) {
    return {Kind::CopyRegisters, to, from, count};
  }
  /// IMS, which is refused during a motion or while the driver is disabled: bit 12 again. Then the wait for
  /// the drive to take a segment that was handed over by register 17.
  static ProgramStep start() { return {Kind::StartInterpolation, 0, 0, 0}; }
  static ProgramStep wait_taken() { return {Kind::WaitSegmentTaken, 0, 0, 0}; }
};

class ProgramTarget;

/// The standalone program of the drive ("SilverLode User Manual", standalone operation; "Interpolated
/// Motion", register based queue); it runs beside a motion, one line a servo tick.
class StoredProgram {
 public:
  /// Replaces the program; none runs after that. CLP loads an empty one.
  void load(std::vector<ProgramStep> steps) {
    steps_ = std::move(steps);
    running_ = false;
  }

  /// RUN: from the first line on, in the next tick. An empty program does not run.
  void run() {
    next_ = 0;
    running_ = !steps_.empty();
  }

  /// No further line is executed; run() begins with the first.
  void stop() { running_ = false; }
  bool running() const { return running_; }

  /// One servo tick while running.
  void tick(ProgramTarget& target);

 private:
  bool execute(const ProgramStep& step, ProgramTarget& target) const;

  std::vector<ProgramStep> steps_;
  std::size_t next_ = 0;
  bool running_ = false;
};

}  // namespace interpolated_motion::emulation
