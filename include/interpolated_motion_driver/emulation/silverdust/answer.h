#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "interpolated_motion_driver/emulation/silverdust/command.h"

namespace interpolated_motion::emulation {

/// What becomes of a command, and so what the drive says to it ("Serial Communications", QCI-TD053).
class Answer {
 public:
  enum class Kind {
    Acknowledge,   ///< `* AA`: obeyed
    Data,          ///< `# AA CCCC DDDD ...`: obeyed, and this is what was asked for
    Nak,           ///< `! AA CCCC EEEE`: refused
    CommandError,  ///< acknowledged, but not obeyed: bit 12 of the polling status word
    BadValue,      ///< an impossible number: Nak or CommandError, as BadValueReply says
    CannotStart,   ///< a motion while the driver is disabled: Nak or CommandError, as DisabledStartReply says
    Restart,       ///< the drive begins anew and says nothing
  };

  /// An Acknowledge.
  Answer() = default;

  /// The other kinds.
  static Answer nak(NakCode code);
  static Answer command_error() { return Answer(Kind::CommandError); }
  static Answer bad_value() { return Answer(Kind::BadValue); }
  static Answer cannot_start() { return Answer(Kind::CannotStart); }
  static Answer restart() { return Answer(Kind::Restart); }

  /// Data without a word yet. `echo`: the command number it repeats.
  static Answer data(std::uint16_t echo);

  /// Data of one word, in answer to `command`.
  static Answer word(Command command, std::uint16_t value);

  /// Adds a 32-bit value to Data, as two words, the high one first. At most four fit.
  void add_long(std::int32_t value);

  /// Adds a word to Data. At most eight fit.
  void add_word(std::uint16_t value) { words_[word_count_++] = value; }

  /// refused(): a Nak, not what may become one.
  Kind kind() const { return kind_; }
  bool refused() const { return kind_ == Kind::Nak; }

  /// Writes the text of an Acknowledge, of Data or of a Nak at the end of `text`, its CR included. `address`:
  /// of the drive; `command`: the number that was heard, which a Nak repeats.
  void append_to(std::string& text, int address, std::uint16_t command) const;

 private:
  static constexpr std::size_t kWords = 8;

  explicit Answer(Kind kind) : kind_(kind) {}

  Kind kind_ = Kind::Acknowledge;
  NakCode code_ = NakCode::BadCommand;
  std::uint16_t echo_ = 0;
  std::array<std::uint16_t, kWords> words_{};
  std::size_t word_count_ = 0;
};

}  // namespace interpolated_motion::emulation
