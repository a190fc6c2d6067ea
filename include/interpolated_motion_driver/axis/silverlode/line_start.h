#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Starts all drives of one serial line with one IMS to the global address, when every axis of the line has
/// asked for it: they begin within one servo tick of each other. No drive answers, so each axis has to look
/// whether its own has begun.
class LineStart {
 public:
  /// `line` must outlive this. `ims_arguments` as silverlode::ims_request() takes them.
  LineStart(silverlode::LineMaster& line, const std::string& ims_arguments);

  /// One more axis takes part in every start. Returns its number for ask() and withdraw().
  std::size_t join() { return members_++; }

  /// The drive of the axis is loaded. The last axis to ask sends the command.
  void ask(std::size_t member);
  /// The axis does not start after all. Without effect once the command has been given to the line.
  void withdraw(std::size_t member) { asked_.erase(member); }
  /// When the last bit of the command was on the line, computed; empty until it has left.
  std::optional<HostTime> sent() const;

  /// `IMS "@255 253 0 0" to all drives of line0`, for texts.
  std::string text() const;

 private:
  silverlode::LineMaster& line_;
  silverlode::Request request_;
  std::size_t members_ = 0;
  std::set<std::size_t> asked_;
  silverlode::RequestId command_ = silverlode::kNoRequest;
};

}  // namespace interpolated_motion::axis
