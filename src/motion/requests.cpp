#include "interpolated_motion_driver/motion/requests.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::motion {

namespace {

struct Verdict {
  bool success;
  std::string message;
};

bool at_rest(GroupState state) {
  return state == GroupState::Idle || state == GroupState::Disabled || state == GroupState::Fault;
}

std::optional<Verdict> verdict_on_enable(GroupState state, const std::string& fault) {
  if (state == GroupState::Idle) return Verdict{true, "all drives are enabled"};
  if (state == GroupState::Fault) return Verdict{false, fault};
  if (state == GroupState::Disabled)
    return Verdict{false, "the drives were disabled meanwhile; call ~enable again"};
  return std::nullopt;
}

std::optional<Verdict> verdict_on_reset(GroupState state, const std::string& fault) {
  if (state == GroupState::Fault) return Verdict{false, fault};
  if (at_rest(state)) return Verdict{true, "faults are reset; call ~enable to switch the drives on"};
  return std::nullopt;
}

std::optional<Verdict> verdict(RequestKind kind, GroupState state, const std::string& fault) {
  switch (kind) {
    case RequestKind::Enable:
      return verdict_on_enable(state, fault);
    case RequestKind::ResetFaults:
      return verdict_on_reset(state, fault);
    case RequestKind::Disable:
    case RequestKind::ShutDown:
      if (state == GroupState::Disabled) return Verdict{true, "all drives are disabled"};
      if (state == GroupState::Fault)
        return Verdict{false, "all drives that can be reached are switched off. " + fault};
      return std::nullopt;
    case RequestKind::Halt:
      if (at_rest(state)) return Verdict{true, "the group is at rest"};
      return std::nullopt;
    case RequestKind::ClearBuffers:
      if (at_rest(state)) return Verdict{true, "the group is at rest and its FIFOs are empty"};
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

RequestId Requests::add(RequestKind kind) {
  pending_.push_back({next_, kind});
  return next_++;
}

void Requests::finish(RequestId id, bool success, std::string message) {
  pending_.erase(
      std::remove_if(pending_.begin(), pending_.end(), [id](const Pending& p) { return p.id == id; }),
      pending_.end());
  results_.push_back({id, success, std::move(message)});
}

void Requests::settle(GroupState state, const std::string& fault) {
  const std::vector<Pending> waiting = pending_;
  for (const Pending& request : waiting) {
    if (auto v = verdict(request.kind, state, fault)) finish(request.id, v->success, std::move(v->message));
  }
}

std::optional<RequestResult> Requests::take_result() {
  if (results_.empty()) return std::nullopt;
  RequestResult result = std::move(results_.front());
  results_.pop_front();
  return result;
}

}  // namespace interpolated_motion::motion
