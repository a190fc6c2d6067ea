#include "interpolated_motion_driver/motion/bus_budget.h"

#include <algorithm>
#include <queue>
#include <vector>

namespace interpolated_motion::motion {

namespace {

struct Job {
  GoalTime release;
  GoalTime deadline;
  double cost;
  bool is_record;
};

bool due_later(const Job& a, const Job& b) { return a.deadline > b.deadline; }

double records_in_second_before(const std::vector<Job>& jobs, GoalTime time) {
  return static_cast<double>(std::count_if(jobs.begin(), jobs.end(), [time](const Job& job) {
    return job.is_record && job.deadline <= time && job.deadline > time - GoalTime{1.0};
  }));
}

/// Earliest deadline first. `blocking`, s: what a record waits for that finds the bus without work.
std::optional<MissedDeadline> carry(std::vector<Job> jobs, GoalTime start, double blocking) {
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const Job& a, const Job& b) { return a.release < b.release; });
  std::priority_queue<Job, std::vector<Job>, decltype(&due_later)> waiting(due_later);
  GoalTime free = start;
  for (auto next = jobs.begin(); next != jobs.end() || !waiting.empty();) {
    if (waiting.empty() && next->release > free) free = next->release + GoalTime{blocking};
    for (; next != jobs.end() && next->release <= free; ++next) waiting.push(*next);
    const Job job = waiting.top();
    waiting.pop();
    free += GoalTime{job.cost};
    if (job.is_record && free > job.deadline) {
      return MissedDeadline{job.deadline, free - job.deadline, records_in_second_before(jobs, job.deadline),
                            0.0};
    }
  }
  return std::nullopt;
}

std::optional<MissedDeadline> carry_in_share(const std::vector<BusDemand>& demands, GoalTime start) {
  std::vector<Job> jobs;
  for (const BusDemand& demand : demands) {
    for (const axis::RecordSlot& slot : demand.slots) {
      if (slot.release > start) jobs.push_back({slot.release, slot.deadline, demand.record_bus_time, true});
    }
  }
  return carry(std::move(jobs), start, 0.0);
}

double share_of_looks(const std::vector<BusDemand>& demands) {
  double share = 0.0;
  for (const BusDemand& demand : demands) {
    if (demand.watch.look_period > 0.0) share += demand.watch.look_time / demand.watch.look_period;
  }
  return share;
}

GoalTime end_of(const std::vector<BusDemand>& demands, GoalTime start) {
  GoalTime end = start;
  for (const BusDemand& demand : demands) {
    for (const axis::RecordSlot& slot : demand.slots) end = std::max(end, slot.deadline);
  }
  return end;
}

/// A question that is due goes before any record. As only one can be under way, they come one after the
/// other: those of one axis begin at `part` of the period.
void add_looks(const axis::BusWatch& watch, double part, GoalTime begin, GoalTime end,
               std::vector<Job>& jobs) {
  if (watch.look_period <= 0.0) return;
  const GoalTime first = begin + GoalTime{part * watch.look_period};
  for (GoalTime due = first; due < end; due += GoalTime{watch.look_period})
    jobs.push_back({due, due, watch.look_time, false});
}

std::optional<MissedDeadline> carry_with_looks(const std::vector<BusDemand>& demands, GoalTime start) {
  std::vector<Job> jobs;
  GoalTime begin = start;
  double blocking = 0.0;
  for (const BusDemand& demand : demands) {
    const GoalTime loaded = start - demand.watch.lead;
    begin = std::min(begin, loaded);
    blocking = std::max(blocking, demand.watch.longest_look);
    for (const axis::RecordSlot& slot : demand.slots) {
      if (slot.release > loaded)
        jobs.push_back({slot.release, slot.deadline, demand.watch.record_time, true});
    }
  }
  const GoalTime end = end_of(demands, start);
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(demands.size());
    add_looks(demands[i].watch, part, begin, end, jobs);
  }
  auto missed = carry(std::move(jobs), begin, blocking);
  if (missed) missed->looks = share_of_looks(demands);
  return missed;
}

}  // namespace

std::optional<MissedDeadline> check_bus_budget(const std::vector<BusDemand>& demands, GoalTime start) {
  const auto missed = carry_in_share(demands, start);
  if (missed || share_of_looks(demands) == 0.0) return missed;
  return carry_with_looks(demands, start);
}

}  // namespace interpolated_motion::motion
