#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/hardware/motion_hardware.h"
#include "simulation/invariant.h"
#include "simulation/ledger.h"
#include "simulation/script.h"
#include "simulation/setpoint_source.h"
#include "simulation/trace.h"
#include "simulation/violation.h"

namespace interpolated_motion::simulation {

/// What has come of a script.
struct Outcome {
  std::optional<Violation> violation;      ///< the first that is no known fault: the simulation ends there
  std::map<std::string, Violation> known;  ///< the first of each known fault, by its name
  std::uint64_t trace = 0;                 ///< hash of all that happened
  bool out_of_memory = false;              ///< an allocation has failed, and the host has ended with that
  double seconds = 0.0;                    ///< virtual time from the driver's start
  std::size_t goals_accepted = 0;
  std::size_t goals_refused = 0;
  std::size_t goals_succeeded = 0;
  std::map<std::string, std::uint64_t> sent;      ///< frames or texts of the host, by bus
  std::map<std::string, std::uint64_t> received;  ///< of others, by bus
};

/// The whole driver with its emulated drives in virtual time, and a script that happens to it.
class Simulation {
 public:
  /// Throws std::invalid_argument where the driver does not take the configuration.
  explicit Simulation(const Script& script, Trace::Listener listener = {});

  /// Carries the script out, then waits until all orders have ended and for a while at rest.
  Outcome run();
  /// The last seconds of the driver, see docs/recording.md. `cause`: why it is wanted.
  std::string recording(const std::string& cause) const;

 private:
  /// A goal that is neither accepted nor refused.
  struct HandedIn {
    Event event;
    bool met_motion = false;  ///< something was under way when it was sent
  };

  void run_script();
  void end_for_want_of_memory();
  void wait_until_ready();
  void wait_for_the_end();
  void run_for(double duration);
  void advance_to(HostTime time);
  void step(HostTime time);
  void deliver_setpoints();

  void carry_out(const Event& event);
  void carry_out_request(const std::string& verb);
  void submit(const Event& event);
  void submit_stop();
  void accept_stop(motion::GoalId id);
  void take_answers();
  bool meets_motion() const;
  void accept(const HandedIn& handed_in, const trajectory::Goal& goal,
              const motion::GoalAcceptance& acceptance);
  void be_late(double duration);
  void inject(const Event& event);

  void look();
  void follow_state();
  void take_results();
  void take_request_results();
  void take_log();
  void take_sample(std::size_t joint, const hardware::DemandSample& sample);
  void take_positions();
  void find_violation();
  void judge(const Violation& violation);
  void say(const std::string& line);
  double script_time() const;
  bool is_over() const { return outcome_.violation.has_value(); }

  Script script_;
  Ledger ledger_;
  std::vector<std::unique_ptr<Invariant>> invariants_;
  Trace trace_;
  HostTime now_{};
  HostTime origin_{};  ///< of the script's clock
  HostTime next_look_{};
  bool host_is_there_ = true;
  std::unique_ptr<hardware::MotionHardware> driver_;
  std::map<hardware::Ticket, HandedIn> handed_in_;
  std::deque<SentSetpoint> setpoints_;
  motion::Snapshot snapshot_;
  std::vector<double> positions_;
  std::vector<bool> powers_;
  std::size_t log_lines_ = 0;
  std::optional<motion::MotionReport> report_;  ///< when a goal has ended since the last look
  Outcome outcome_;
};

/// Runs `script`. Whatever is thrown is a violation of "no exception".
Outcome simulate(const Script& script, Trace::Listener listener = {});
/// The same, and the recording of it, empty where the driver did not take the configuration.
Outcome simulate_recorded(const Script& script, std::string& recording);

}  // namespace interpolated_motion::simulation
