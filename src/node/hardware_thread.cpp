#include "interpolated_motion_driver/node/hardware_thread.h"

#include <pthread.h>

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace interpolated_motion::node {
namespace {

/// Frames come in bursts, the answers of all drives to one SYNC: one turn serves what comes within that time.
constexpr HostDuration kBurst = std::chrono::milliseconds(1);
/// Shortest sleep. A deadline that is always in the past must not make a SCHED_FIFO thread starve the
/// machine.
constexpr HostDuration kShortestSleep = std::chrono::microseconds(100);

}  // namespace

HardwareThread::HardwareThread(const Factory& make, const Settings& settings, Listener listener)
    : settings_(settings),
      listener_(std::move(listener)),
      hardware_(make({&io_, [this] { wake(); }})),
      planner_(
          [this](const motion::PlanningPtr& planning, HostDuration taken) { planned(planning, taken); }) {
  hardware_->set_planner([this](motion::PlanningPtr planning) { planner_.plan(std::move(planning)); });
  thread_ = std::thread([this] { run(); });
}

HardwareThread::~HardwareThread() { stop(); }

void HardwareThread::stop() {
  io_.stop();
  if (thread_.joinable()) thread_.join();
}

void HardwareThread::run() {
  try {
    apply_priority();
    tick();
    io_.run();
  } catch (const std::exception& error) {
    listener_.failed(error.what());
  }
  ended_ = true;
}

void HardwareThread::apply_priority() {
  if (settings_.realtime_priority == 0) return;
  sched_param parameters{};
  parameters.sched_priority = settings_.realtime_priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error == 0) return;
  listener_.log(
      {Hardware::Severity::Warning,
       fmt::format(
           "realtime_priority {} is not granted ({}); the bus thread runs with normal priority. Allow it by "
           "'rtprio' in /etc/security/limits.conf",
           settings_.realtime_priority, std::strerror(error))});
}

void HardwareThread::wake() {
  const HostTime due = last_tick_ + kBurst;
  if (host_now() >= due) return tick();
  if (timer_.expiry() > to_steady(due)) schedule_at(due);
}

void HardwareThread::tick() {
  last_tick_ = host_now();
  hardware_->update(last_tick_);
  hand_out_events();
  hand_out_snapshot();
  turns_.note(last_tick_, host_now());
  schedule();
}

void HardwareThread::hand_out_events() {
  while (const auto entry = hardware_->take_log()) listener_.log(*entry);
  while (const auto answer = hardware_->take_goal_answer()) listener_.goal_answered(*answer);
  while (const auto result = hardware_->take_goal_result()) listener_.goal_ended(*result);
  while (auto result = hardware_->take_request_result()) {
    const auto waiting = requests_.find(result->id);
    if (waiting == requests_.end()) continue;
    waiting->second->set_value(std::move(*result));
    requests_.erase(waiting);
  }
}

void HardwareThread::hand_out_snapshot() {
  hardware_->snapshot(back_);
  // Whoever copies the front right now is served by the next tick: this thread does not wait for readers.
  const std::unique_lock<std::mutex> lock(front_mutex_, std::try_to_lock);
  if (lock) std::swap(back_, front_);
}

void HardwareThread::schedule() {
  const HostTime now = host_now();
  const HostTime due = std::min(hardware_->next_deadline(), now + settings_.loop_period);
  schedule_at(std::max(due, now + kShortestSleep));
}

void HardwareThread::schedule_at(HostTime time) {
  timer_.expires_at(to_steady(time));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) tick();
  });
}

void HardwareThread::post(std::function<void(Hardware&, HostTime)> function) {
  boost::asio::post(io_, [this, function = std::move(function)] {
    const HostTime begin = host_now();
    function(*hardware_, begin);
    turns_.note(begin, host_now());
  });
}

motion::RequestResult HardwareThread::request(std::function<motion::RequestId(Hardware&, HostTime)> start,
                                              HostDuration patience) {
  auto promise = std::make_shared<std::promise<motion::RequestResult>>();
  auto future = promise->get_future();
  post([this, promise, start = std::move(start)](Hardware& hardware, HostTime now) {
    requests_.emplace(start(hardware, now), promise);
    wake();  // what it sends goes out now, not with the next deadline
  });
  auto result = wait(std::move(future), host_now() + patience);
  if (result) return *result;
  return {0, false,
          ended_ ? "the driver is shutting down" : fmt::format("not done within {:g} s", seconds(patience))};
}

std::optional<hardware::Ticket> HardwareThread::submit(trajectory::Goal goal) {
  return call([this, goal = planner_.keep(std::move(goal))](Hardware& hardware, HostTime now) {
    const hardware::Ticket ticket = hardware.submit_later(goal, now);
    wake();  // what is refused at once is told at once
    return ticket;
  });
}

void HardwareThread::planned(const motion::PlanningPtr& planning, HostDuration taken) {
  post([this, planning, taken](Hardware& hardware, HostTime now) {
    hardware.planned(*planning, taken, now);
    wake();
  });
}

void HardwareThread::snapshot(motion::Snapshot& out) const {
  const std::lock_guard<std::mutex> lock(front_mutex_);
  out = front_;
}

void HardwareThread::shut_down(HostDuration patience) {
  if (!ended_) request([](Hardware& hardware, HostTime now) { return hardware.shut_down(now); }, patience);
  stop();
}

}  // namespace interpolated_motion::node
