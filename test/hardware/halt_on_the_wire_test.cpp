#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

// From the call of a halt in motion to what tells each drive to stop, as one reads it off the wire: it goes
// out with the next update, and nothing but the bus itself lies between.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

constexpr std::uint32_t kTargets = 0x200;       // RPDO 1, plus the node id
constexpr std::uint32_t kControlwords = 0x300;  // RPDO 2, plus the node id
constexpr unsigned kHalt = 0x01;                // bit 8, in the second byte

struct Drive {
  std::string bus;
  std::string type;
  int number = 0;  ///< node id or address
};

std::vector<Drive> drives_of(const YAML::Node& arm) {
  std::vector<Drive> drives;
  for (const auto& joint : arm["joints"]) {
    const YAML::Node drive = arm["drives"][joint.as<std::string>()];
    const YAML::Node number = drive["node_id"] ? drive["node_id"] : drive["address"];
    drives.push_back({drive["bus"].as<std::string>(), drive["type"].as<std::string>(), number.as<int>()});
  }
  return drives;
}

/// What the host has sent to one drive, with the times at which it was on the wire.
struct Sent {
  HostTime time{};
  std::string content;
};

/// An arm in motion, and what its drives are sent from now on that moves or stops them: target positions,
/// halts, STP.
class WatchedArm {
 public:
  WatchedArm(const YAML::Node& arm, double seconds) : drives_(drives_of(arm)), scenario_(arm) {
    EXPECT_TRUE(scenario_.run_until_state(GroupState::Idle)) << scenario_.snapshot().fault;
    const auto accepted = scenario_.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
    EXPECT_TRUE(accepted);
    EXPECT_TRUE(scenario_.run_until_state(GroupState::Moving));
    scenario_.run(seconds);
    sent_.resize(drives_.size());
    scenario_.driver().set_wire_observer(
        {[this](const std::string& bus, const canopen::ReceivedFrame& frame) { take(bus, frame); },
         [this](const std::string& bus, const hardware::SerialText& line) { take(bus, line); }});
  }

  Scenario& scenario() { return scenario_; }
  const std::vector<Drive>& drives() const { return drives_; }
  const std::vector<Sent>& sent(std::size_t drive) const { return sent_[drive]; }

 private:
  void take(const std::string& bus, const canopen::ReceivedFrame& received) {
    const canopen::Frame& frame = received.frame;
    if (!received.own) return;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      const auto node = static_cast<std::uint32_t>(drives_[i].number);
      if (drives_[i].bus != bus || drives_[i].type == "silverlode_ims") continue;
      const bool halts = frame.id == kControlwords + node && (frame.data[1] & kHalt) != 0;
      const bool moves = drives_[i].type == "cyclic" && frame.id == kTargets + node;
      if (halts || moves)
        sent_[i].push_back({received.time, std::string(frame.data.begin(), frame.data.end())});
    }
  }

  void take(const std::string& bus, const hardware::SerialText& line) {
    for (std::size_t i = 0; line.from_host && i < drives_.size(); ++i) {
      const std::string stop = fmt::format("@{} 3 ", drives_[i].number);
      if (drives_[i].bus == bus && line.text.substr(0, stop.size()) == stop)
        sent_[i].push_back({line.time, std::string(line.text)});
    }
  }

  std::vector<Drive> drives_;
  Scenario scenario_;
  std::vector<std::vector<Sent>> sent_;
};

/// What tells a drive to stop is the first that its twin, which is not to stop, is not told.
std::optional<HostTime> told(const std::vector<Sent>& stopped, const std::vector<Sent>& twin) {
  for (std::size_t i = 0; i < stopped.size(); ++i)
    if (i >= twin.size() || twin[i].content != stopped[i].content) return stopped[i].time;
  return std::nullopt;
}

/// ms at most from a call to the wire, of the drive that is told last. EPOS2: the millisecond until the next
/// update, six frames, and one that is on the bus already. Cyclic: the target of the next SYNC, which comes
/// each 10 ms. SilverLode: the exchange under way, and then the three drives of a line one after the other.
const std::map<std::string, double> kLatest{{"epos_ipm", 2.0}, {"cyclic", 12.0}, {"silverlode_ims", 30.0}};

class HaltOnTheWire : public ::testing::TestWithParam<KindOfArm> {};

TEST_P(HaltOnTheWire, EveryDriveIsToldWithTheNextUpdate) {
  const YAML::Node arm = GetParam().arm("");
  std::map<std::string, double> latest;
  for (int k = 0; k < 10; ++k) {
    const double instant = 1.0 + 0.0137 * k;
    WatchedArm stopped(arm, instant);
    WatchedArm twin(arm, instant);
    const HostTime called = stopped.scenario().now();
    stopped.scenario().driver().halt(called);
    stopped.scenario().run(0.1);
    twin.scenario().run(0.1);
    for (std::size_t i = 0; i < stopped.drives().size(); ++i) {
      const auto time = told(stopped.sent(i), twin.sent(i));
      ASSERT_TRUE(time) << "joint" << i + 1;
      double& most = latest[stopped.drives()[i].type];
      most = std::max(most, 1e3 * seconds(*time - called));
    }
  }
  for (const auto& [type, most] : latest) {
    fmt::print("| {} | {} | {:.2f} ms |\n", GetParam().name, type, most);
    EXPECT_LE(most, kLatest.at(type)) << type;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, HaltOnTheWire, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
