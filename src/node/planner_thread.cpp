#include "interpolated_motion_driver/node/planner_thread.h"

#include <pthread.h>

#include <exception>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/post.hpp>

#include "interpolated_motion_driver/node/clock.h"

namespace interpolated_motion::node {
namespace {

/// This thread computes for long and is in no hurry: who wakes up goes first.
void be_in_no_hurry() {
  const sched_param parameters{};
  static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_BATCH, &parameters));
}

void run(motion::Planning& planning) {
  try {
    planning.run();
  } catch (const std::exception& error) {
    planning.refusal =
        Refusal{GoalError::InvalidGoal, fmt::format("The goal cannot be planned: {}.", error.what())};
  }
}

}  // namespace

PlannerThread::PlannerThread(Done done) : done_(std::move(done)) {
  boost::asio::post(*pool_, be_in_no_hurry);
}

PlannerThread::~PlannerThread() {
  pool_->stop();
  pool_->join();
}

motion::GoalPtr PlannerThread::keep(trajectory::Goal goal) const {
  const auto dispose = [pool = pool_](const trajectory::Goal* kept) {
    boost::asio::post(*pool, [owned = std::shared_ptr<const trajectory::Goal>(kept)] {});
  };
  return {new trajectory::Goal(std::move(goal)), dispose};
}

void PlannerThread::plan(motion::PlanningPtr planning) {
  boost::asio::post(*pool_, [this, planning = std::move(planning)] {
    const HostTime begin = host_now();
    run(*planning);
    done_(planning, host_now() - begin);
  });
}

}  // namespace interpolated_motion::node
