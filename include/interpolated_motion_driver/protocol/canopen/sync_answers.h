#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"

namespace interpolated_motion::canopen {

/// The TPDOs with which a node answers every SYNC (transmission type 1; CiA 301, 7.5.2.37). Nothing in such a
/// PDO tells to which SYNC it is the answer, so the master does well to wait for it before it sends another.
class SyncAnswers {
 public:
  /// TPDO `n` (1..4) answers every SYNC once the node is operational.
  void expect(int n) { pdo(n).expected = true; }

  /// A SYNC has been on the bus. Only a TPDO that has come after the last one is waited for: a node that is
  /// off or not yet operational does not answer.
  void on_sync() {
    for (Pdo& one : pdos_) {
      if (one.answers) ++one.missing;
    }
  }

  /// TPDO `n` (1..4) has come.
  void on_tpdo(int n) {
    Pdo& one = pdo(n);
    one.answers = one.expected;
    if (one.missing > 0) --one.missing;
  }

  /// Whether an answer is still to come.
  bool missing() const {
    return std::any_of(pdos_.begin(), pdos_.end(), [](const Pdo& one) { return one.missing > 0; });
  }

  /// Answers that are missing will not come; their TPDOs are waited for again when they have come once more.
  void give_up() {
    for (Pdo& one : pdos_) {
      if (one.missing > 0) one.answers = false;
      one.missing = 0;
    }
  }

 private:
  struct Pdo {
    bool expected = false;  ///< said by expect()
    bool answers = false;   ///< has come since it was expected, and has not been given up
    int missing = 0;        ///< SYNCs without their answer so far
  };

  Pdo& pdo(int n) { return pdos_[static_cast<std::size_t>(n - 1)]; }

  std::array<Pdo, kPdosOfNode> pdos_{};
};

}  // namespace interpolated_motion::canopen
