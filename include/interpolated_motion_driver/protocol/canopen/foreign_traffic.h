#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// Why a received frame could not be used.
enum class UnexpectedFrame {
  UnknownCobId,  ///< identifier outside the predefined connection set
  RemoteFrame,
  ExtendedFrame,     ///< 29-bit identifier
  UnconfiguredNode,  ///< a service of a node that was not added
  OtherMaster,       ///< NMT, SYNC, TIME, RPDO, SDO request or heartbeat with this host's id, sent by another
  Malformed,         ///< heartbeat or EMCY of a wrong length
};
inline constexpr int kUnexpectedFrameCauses = 6;  ///< values of UnexpectedFrame

/// Frames of one cause: how many, and the last of them.
struct UnexpectedFrames {
  std::uint64_t count = 0;  ///< since the master was made
  Frame last;               ///< only where `count` is not 0
  HostTime time{};          ///< of `last`
};

/// What others say on a bus that a master has for itself: frames it has no use for, and those by which
/// another master gives itself away, since it would command the same drives: NMT, SYNC, an RPDO or an SDO
/// request to a drive of this master, a heartbeat with its own id, and TIME where it sets the drives' clocks.
class ForeignTraffic {
 public:
  /// `listen`, >= 0: how long a bus must have been without another master before this one talks. Not `alone`:
  /// others are allowed, and not looked for.
  ForeignTraffic(HostDuration listen, bool alone)
      : listen_(listen), alone_(alone), talks_(!alone || listen <= HostDuration::zero()) {}

  /// A frame that is of no use.
  void count(UnexpectedFrame cause, const ReceivedFrame& received);
  /// A frame of another master, counted already.
  void note_master(const ReceivedFrame& received);

  const UnexpectedFrames& unexpected(UnexpectedFrame cause) const;
  /// "3 frames of nodes that are not configured, last: TPDO 1 of node 9, 189#3702"; empty when there were
  /// none.
  std::string unexpected_text(UnexpectedFrame cause) const;

  /// The bus is listened to from the first call on. Returns whether it may be talked on: it has been quiet()
  /// once, and who has begun to talk goes on.
  bool listen(HostTime now);
  bool talks() const { return talks_; }  ///< as of the latest listen()
  /// Nothing has been listened to yet, until the next listen(): the bus was down.
  void deafen() { since_ = kNever; }
  /// There has been no other master for as long as there must be none.
  bool quiet(HostTime now) const;
  /// When quiet() turns true, if none comes; kNever while nobody listens.
  HostTime quiet_from() const;
  HostDuration patience() const { return listen_; }  ///< as given to the constructor

  /// Frames of another master so far, where none is allowed.
  std::uint64_t of_master() const { return alone_ ? master_.count : 0; }
  /// "SYNC, 080#": the last of them; empty when there were none.
  std::string master_text() const;
  /// The last of them was TIME.
  bool master_sets_clocks() const;

 private:
  std::array<UnexpectedFrames, kUnexpectedFrameCauses> unexpected_{};
  UnexpectedFrames master_;
  HostDuration listen_;
  bool alone_;
  bool talks_;
  HostTime since_ = kNever;
};

}  // namespace interpolated_motion::canopen
