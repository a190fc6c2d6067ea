#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <actionlib/client/simple_action_client.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <fmt/format.h>
#include <interpolated_motion_driver/GetMotionReport.h>
#include <ros/master.h>
#include <ros/ros.h>

#include "driver_instance.h"
#include "goal_file.h"
#include "options.h"
#include "progress.h"
#include "report.h"
#include "setpoint_stream.h"

namespace interpolated_motion::tools {
namespace {

using Client = actionlib::SimpleActionClient<control_msgs::FollowJointTrajectoryAction>;
using Clock = std::chrono::steady_clock;
using State = actionlib::SimpleClientGoalState;

enum ExitCode { Succeeded = 0, BadInput = 2, Rejected = 3, NotSucceeded = 4, Timeout = 5 };

/// s beyond the goal's own length, for lead-in, settling and a loaded machine.
constexpr double kGoalPatience = 60.0;
/// s for a driver that is there to find, configure and enable its drives.
constexpr double kBringUpPatience = 60.0;
constexpr auto kStep = std::chrono::milliseconds(100);

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double length_of(const trajectory_msgs::JointTrajectory& trajectory) {
  return trajectory.points.empty() ? 0.0 : trajectory.points.back().time_from_start.toSec();
}

void say(const std::string& text) {
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void complain(const std::string& text) { std::fputs(("trajectory_client: " + text + "\n").c_str(), stderr); }

/// Waits on the wall clock: simulated ROS time may stand still.
template <class Done, class EachStep>
bool wait_until(Clock::time_point deadline, Done done, EachStep each_step) {
  while (!ros::isShuttingDown()) {
    if (done()) return true;
    if (Clock::now() > deadline) return false;
    each_step();
    std::this_thread::sleep_for(kStep);
  }
  return false;
}

/// Says every 5 s, from the first second on, what is waited for.
template <class Done>
bool wait_and_say(Clock::time_point deadline, const std::string& what, Done done) {
  auto next_message = Clock::now() + std::chrono::seconds(1);
  return wait_until(deadline, done, [&] {
    if (Clock::now() < next_message) return;
    const auto left = std::chrono::duration<double>(deadline - Clock::now()).count();
    say(fmt::format("waiting for {}, {:.0f} s more at most", what, std::max(left, 0.0)));
    next_message = Clock::now() + std::chrono::seconds(5);
  });
}

/// Anything else of ROS would wait for its master for ever.
bool wait_for_master(Clock::time_point deadline) {
  const std::string master = "ROS's master at " + ros::master::getURI();
  if (wait_and_say(deadline, master, [] { return ros::master::check(); })) return true;
  complain("no answer from " + master);
  return false;
}

/// The driver that is moved is the one that is there when it is asked, or that comes while it is waited for.
bool wait_for_driver(DriverInstance& driver, Clock::time_point deadline) {
  const std::string what = "the driver " + driver.node();
  if (wait_and_say(deadline, what, [&] { return driver.found(); })) return true;
  complain(fmt::format(
      "there is no node {}. Start the driver first, or say by --wait SECONDS how long to wait for "
      "one that is still to be started",
      driver.node()));
  return false;
}

/// It serves its action when its drives have been found, configured and enabled.
bool wait_for_server(Client& client, const DriverInstance& driver, Clock::time_point deadline) {
  const std::string action = fmt::format("the action {}/follow_joint_trajectory", driver.node());
  if (!wait_and_say(deadline, action, [&] { return client.isServerConnected(); })) {
    complain(fmt::format("{} does not serve {}: its log says what it waits for", driver.node(), action));
    return false;
  }
  if (driver.is_there()) return true;
  complain(fmt::format("the driver {} has ended and another one has been started; it is sent nothing",
                       driver.node()));
  return false;
}

void print_report(ros::NodeHandle& ros_node, const std::string& node) {
  interpolated_motion_driver::GetMotionReport service;
  auto client = ros_node.serviceClient<interpolated_motion_driver::GetMotionReport>(node + "/motion_report");
  if (client.call(service)) {
    std::fputs(report_text(service.response).c_str(), stdout);
  } else {
    complain(fmt::format("{}/motion_report does not answer", node));
  }
}

std::string ending(const State& state, const std::string& text) {
  return text.empty() ? state.toString() : state.toString() + ": " + text;
}

ExitCode exit_code(const State& state) {
  if (state == State::SUCCEEDED) return Succeeded;
  return state == State::REJECTED ? Rejected : NotSucceeded;
}

/// Until when this run may wait.
struct Deadlines {
  Clock::time_point there;               ///< for ROS's master and the driver
  Clock::time_point ready;               ///< for the driver's action
  std::optional<Clock::time_point> end;  ///< for all of it
};

Deadlines deadlines(const Options& options) {
  const double there = options.wait;
  const double ready = std::max(options.wait, kBringUpPatience);
  if (options.timeout == 0.0) return {after(there), after(ready), std::nullopt};
  const double all = options.timeout;
  return {after(std::min(there, all)), after(std::min(ready, all)), after(all)};
}

ExitCode send(const Options& options, const Deadlines& until, const DriverInstance& driver,
              const trajectory_msgs::JointTrajectory& trajectory) {
  ros::NodeHandle ros_node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  Client client(options.node + "/follow_joint_trajectory", false);
  if (!wait_for_server(client, driver, until.ready)) return Timeout;

  Progress progress(length_of(trajectory));
  const auto buffers = ros_node.subscribe<interpolated_motion_driver::BufferStatus>(
      options.node + "/buffer_status", 1,
      [&progress](const interpolated_motion_driver::BufferStatus::ConstPtr& message) {
        progress.buffers(*message);
      });
  control_msgs::FollowJointTrajectoryGoal goal;
  goal.trajectory = trajectory;
  say(fmt::format("sending {} points, {:.3f} s", trajectory.points.size(), length_of(trajectory)));
  client.sendGoal(goal, {}, {}, [&progress](const auto& feedback) { progress.feedback(*feedback); });

  const auto deadline = until.end.value_or(after(length_of(trajectory) + kGoalPatience));
  const bool ended = wait_until(
      deadline, [&] { return client.getState().isDone(); },
      [&] {
        if (client.getState() == State::ACTIVE) progress.show();
      });
  progress.finish();
  if (!ended) {
    client.cancelGoal();
    // Leaving at once could lose the message on its way.
    wait_until(
        after(2.0), [&] { return client.getState().isDone(); }, [] {});
    complain("no result in time; the goal is cancelled");
    return Timeout;
  }
  if (client.getState() != State::REJECTED) print_report(ros_node, options.node);
  const auto result = client.getResult();  // none when the driver died meanwhile
  say(ending(client.getState(), result ? result->error_string : client.getState().getText()));
  return exit_code(client.getState());
}

ExitCode stream(const Options& options, const Deadlines& until, const DriverInstance& driver) {
  ros::NodeHandle ros_node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  Client client(options.node + "/follow_joint_trajectory", false);
  if (!wait_for_server(client, driver, until.ready)) return Timeout;
  const bool followed = stream_setpoints(ros_node, {options.node, options.setpoints, options.lost});
  print_report(ros_node, options.node);
  say(followed ? "FOLLOWED" : "NOT FOLLOWED");
  return followed ? Succeeded : NotSucceeded;
}

ExitCode run(const Options& options) {
  const auto until = deadlines(options);
  // Read before anything is waited for: a bad file is told at once.
  const auto goal =
      options.goal_file.empty() ? trajectory_msgs::JointTrajectory() : read_goal_file(options.goal_file);
  if (!wait_for_master(until.there)) return Timeout;
  DriverInstance driver(options.node);
  if (!wait_for_driver(driver, until.there)) return Timeout;
  return options.goal_file.empty() ? stream(options, until, driver) : send(options, until, driver, goal);
}

}  // namespace
}  // namespace interpolated_motion::tools

int main(int argc, char** argv) {
  using namespace interpolated_motion::tools;
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  arguments.erase(arguments.begin());
  try {
    const auto options = parse_options(arguments);
    if (!options) {
      std::fputs(usage().c_str(), stdout);
      return Succeeded;
    }
    ros::init(argc, argv, "trajectory_client", ros::init_options::AnonymousName);
    return run(*options);
  } catch (const std::exception& error) {
    complain(error.what());
    return BadInput;
  }
}
