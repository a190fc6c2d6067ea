#include "interpolated_motion_driver/motion/bus_budget.h"

#include <algorithm>

namespace interpolated_motion::motion {

namespace {

struct Job {
  GoalTime release;
  GoalTime deadline;
  double cost;
};

std::vector<Job> jobs_by_deadline(const std::vector<BusDemand>& demands, GoalTime start) {
  std::vector<Job> jobs;
  for (const BusDemand& demand : demands) {
    for (const axis::RecordSlot& slot : demand.slots) {
      if (slot.release > start) jobs.push_back({slot.release, slot.deadline, demand.record_bus_time});
    }
  }
  std::sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.deadline < b.deadline; });
  return jobs;
}

double records_in_second_before(const std::vector<Job>& jobs, GoalTime time) {
  return static_cast<double>(std::count_if(jobs.begin(), jobs.end(), [time](const Job& job) {
    return job.deadline <= time && job.deadline > time - GoalTime{1.0};
  }));
}

}  // namespace

std::optional<MissedDeadline> check_bus_budget(const std::vector<BusDemand>& demands, GoalTime start) {
  const std::vector<Job> jobs = jobs_by_deadline(demands, start);
  GoalTime free = start;
  for (const Job& job : jobs) {
    free = std::max(free, job.release) + GoalTime{job.cost};
    if (free > job.deadline)
      return MissedDeadline{job.deadline, records_in_second_before(jobs, job.deadline)};
  }
  return std::nullopt;
}

}  // namespace interpolated_motion::motion
