#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"

namespace interpolated_motion::axis {

/// Segments through the drive's Interpolated Move Queue (QCI-TD044, "Host Based Control"): one IMW each.
/// "Full" is known from the clock before the drive says so.
///
/// A segment whose ACK was lost must not get into the queue twice. It is sent again only when it has filled
/// the last place of the queue and no place becomes free meanwhile: then NAK "full" says that it was in, and
/// ACK that it was not. Otherwise nobody can know, and the motion cannot go on.
class QueueDelivery : public SegmentDelivery {
 public:
  /// `depth`: places of the queue; 0: measured at bring-up.
  QueueDelivery(const DeliveryContext& context, std::size_t depth);

  /// Time of the line that one segment takes, s: the longest IMW with its ACK.
  static double segment_time(const silverlode::LineMaster& line);

  std::string description() const override;
  std::size_t capacity() const override { return depth_; }
  Steps bring_up_steps() override;
  Steps clear_steps() override;
  double shortest_segment() const override { return 0.0; }
  double record_bus_time() const override { return segment_time(line()) / line_share(); }
  double record_time() const override;
  std::size_t records_per_segment() const override { return 1; }
  SlotRule slot_rule(double horizon) const override;

  void begin() override;
  Failure offer(bool more, double rate, HostTime now) override;
  Failure take(const silverlode::Outcome& outcome, HostTime now) override;
  void give_up() override;
  std::size_t delivered() const override { return feed().sent(); }

 private:
  /// What became of the segment sent last.
  enum class Fate { None, Sent, Unknown, SentAgain };

  Steps measure_depth();
  CommandSequence::Step try_one_more();
  Failure take_refusal(const silverlode::Outcome& outcome, HostTime now);
  Failure resolve_unknown(const silverlode::Outcome& outcome, HostTime now);
  bool full_queue_would_tell(HostTime now) const;

  bool measures_depth_;
  std::size_t depth_;
  Fate fate_ = Fate::None;
  HostTime retry_at_{};
  int misunderstood_ = 0;  ///< refusals in a row for another reason than a full queue
};

}  // namespace interpolated_motion::axis
