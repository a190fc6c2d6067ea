#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/silverlode/line_text.h"
#include "interpolated_motion_driver/protocol/silverlode/reply.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// What a character completed.
enum class Parsed : std::uint8_t {
  Nothing,
  Reply,      ///< `reply()` is a whole reply
  Echo,       ///< a line that starts with '@': this host's own, heard back on a two-wire line
  Malformed,  ///< a line that is no reply; `line()` is its text
};

/// Makes replies of the characters received. '*', '#', '!' and '@' start a line wherever they come, CR ends
/// it. Tolerated: runs of spaces, a space before the CR, LF anywhere, lower case, characters before the start
/// of a line. Numbers must have all their digits, and the line no more fields than its kind has; a line
/// beyond 64 characters is malformed. The 8-bit ASCII protocol has no checksum: a digit turned into another
/// one is not seen.
class ReplyParser {
 public:
  /// `time` is when the character's last bit arrived.
  Parsed on_character(char c, HostTime time);

  /// Of the last `Parsed::Reply`.
  const Reply& reply() const { return reply_; }
  /// The line that ended last, or that is being received: without its CR. Characters dropped before its start
  /// are not in it, except in a malformed line without any start.
  const LineText& line() const { return line_; }
  /// Characters of an unfinished line are there.
  bool in_line() const { return !ended_ && !line_.empty(); }
  /// Forgets an unfinished line.
  void reset();

  /// Characters dropped because a line started anew behind them.
  std::uint64_t dropped_characters() const { return dropped_characters_; }

 private:
  void start_line(char c, HostTime time);
  Parsed end_line(HostTime time);
  bool parse();

  LineText line_;
  bool ended_ = true;  ///< `line_` has had its CR
  HostTime begin_{};
  Reply reply_;
  std::uint64_t dropped_characters_ = 0;
};

}  // namespace interpolated_motion::silverlode
