#include "interpolated_motion_driver/axis/silverlode/line_start.h"

#include <fmt/format.h>

namespace interpolated_motion::axis {

LineStart::LineStart(silverlode::LineMaster& line, const std::string& ims_arguments)
    : line_(line), request_(silverlode::ims_request(silverlode::kGlobalAddress, ims_arguments)) {}

void LineStart::ask(std::size_t member) {
  if (asked_.empty()) command_ = silverlode::kNoRequest;
  asked_.insert(member);
  if (asked_.size() < members_) return;
  command_ = line_.broadcast(request_);
  asked_.clear();
}

std::optional<HostTime> LineStart::sent() const {
  if (command_ == silverlode::kNoRequest) return std::nullopt;
  return line_.broadcast_end(command_);
}

std::string LineStart::text() const {
  return fmt::format("IMS \"{}\" to all drives of {}", request_.text.printable(), line_.line_name());
}

}  // namespace interpolated_motion::axis
