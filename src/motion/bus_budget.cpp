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
};

std::vector<Job> jobs_by_release(const std::vector<BusDemand>& demands, GoalTime start) {
  std::vector<Job> jobs;
  for (const BusDemand& demand : demands) {
    for (const axis::RecordSlot& slot : demand.slots) {
      if (slot.release > start) jobs.push_back({slot.release, slot.deadline, demand.record_bus_time});
    }
  }
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const Job& a, const Job& b) { return a.release < b.release; });
  return jobs;
}

bool due_later(const Job& a, const Job& b) { return a.deadline > b.deadline; }

double records_in_second_before(const std::vector<Job>& jobs, GoalTime time) {
  return static_cast<double>(std::count_if(jobs.begin(), jobs.end(), [time](const Job& job) {
    return job.deadline <= time && job.deadline > time - GoalTime{1.0};
  }));
}

}  // namespace

std::optional<MissedDeadline> check_bus_budget(const std::vector<BusDemand>& demands, GoalTime start) {
  const std::vector<Job> jobs = jobs_by_release(demands, start);
  std::priority_queue<Job, std::vector<Job>, decltype(&due_later)> waiting(due_later);
  GoalTime free = start;
  for (auto next = jobs.begin(); next != jobs.end() || !waiting.empty();) {
    if (waiting.empty()) free = std::max(free, next->release);
    for (; next != jobs.end() && next->release <= free; ++next) waiting.push(*next);
    const Job job = waiting.top();
    waiting.pop();
    free += GoalTime{job.cost};
    if (free > job.deadline) {
      return MissedDeadline{job.deadline, free - job.deadline, records_in_second_before(jobs, job.deadline)};
    }
  }
  return std::nullopt;
}

}  // namespace interpolated_motion::motion
