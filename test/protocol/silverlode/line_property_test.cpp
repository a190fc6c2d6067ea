#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "protocol/property_cases.h"
#include "protocol/silverlode/scripted_line.h"

namespace interpolated_motion::silverlode::test {
namespace {

using interpolated_motion::test::below;
using interpolated_motion::test::property_cases;

/// Drives on a bad line. Every request carries a number of its own, so that it can be told which of them an
/// answer is for; a drive executes a request at once and answers unless the line loses, delays or spoils it.
class BadLine {
 public:
  explicit BadLine(std::uint64_t seed) : random_(seed) {}

  std::vector<Answer> operator()(const std::string& request) {
    unsigned address = 0;
    unsigned command = 0;
    unsigned number = 0;
    std::sscanf(request.c_str(), "@%u %u %u", &address, &command, &number);
    ++sent_[request];
    const std::uint32_t fate = below(random_, 12);
    if (fate == 0) return {};  // lost on its way to the drive
    const bool full = command == 25 && below(random_, 4) == 0;
    if (!full) executed_.insert(request);
    return answer(fate, reply(address, command, number, full), address);
  }

  const std::map<std::string, int>& sent() const { return sent_; }
  bool executed(const std::string& request) const { return executed_.count(request) != 0; }

 private:
  static std::string reply(unsigned address, unsigned command, unsigned number, bool full) {
    char text[40];
    if (full) {
      std::snprintf(text, sizeof text, "! %02X 0019 0006\r", address);
    } else if (command == 12) {
      std::snprintf(text, sizeof text, "# %02X 000C 5A5A %04X\r", address, number);
    } else {
      std::snprintf(text, sizeof text, "* %02X\r", address);
    }
    return text;
  }

  std::vector<Answer> answer(std::uint32_t fate, std::string text, unsigned address) {
    const HostDuration delay = (500 + below(random_, 15000)) * kUs;
    switch (fate) {
      case 1:  // the answer is lost
        return {};
      case 2:  // late, yet before time-out and guard are over
        return {{text, 20 * kMs + below(random_, 10000) * kUs}};
      case 3:  // without its end
        return {{text.substr(0, 1 + below(random_, static_cast<std::uint32_t>(text.size() - 1))), delay}};
      case 4:  // a character spoiled beyond recognition
        text[below(random_, static_cast<std::uint32_t>(text.size()))] = '\x15';
        return {{text, delay}};
      case 5: {  // another drive answers first
        char other[8];
        std::snprintf(other, sizeof other, "* %02X\r", address ^ 1u);
        return {{other, 100 * kUs}, {text, 2 * kMs + delay}};
      }
      case 6:  // noise before it
        return {{"\xFF 0z" + text, delay}};
      default:
        return {{text, delay}};
    }
  }

  std::mt19937_64 random_;
  std::map<std::string, int> sent_;
  std::set<std::string> executed_;
};

std::string without_cr(const Request& request) {
  return std::string(request.text.view().substr(0, request.text.view().size() - 1));
}

void check_outcome(const BadLine& line, const Outcome& outcome, int number, bool control) {
  const std::string text = without_cr(outcome.request);
  const int sent = line.sent().count(text) != 0 ? line.sent().at(text) : 0;
  EXPECT_EQ(sent, outcome.attempts) << text;
  EXPECT_LE(sent, control ? 4 : 1) << text;
  if (outcome.accepted()) {
    EXPECT_TRUE(line.executed(text)) << text << " was not executed";
  }
  if (outcome.kind == OutcomeKind::Refused) {
    EXPECT_FALSE(line.executed(text)) << text << " was executed";
  }
  if (outcome.request.command == Command::RRG && outcome.accepted()) {
    EXPECT_EQ(outcome.register_value(), 0x5A5A0000 + number) << "answer of another request: " << text;
  }
}

// On a line that loses, delays and spoils replies: every request ends once, what is said to be executed was,
// what is said to be refused was not, no answer is taken for that of another request, and IMW goes out once.
TEST(LineProperty, NoAnswerIsTakenForAnother) {
  int accepted = 0;
  int unknown = 0;
  for (int seed = 1; seed <= property_cases(60); ++seed) {
    BadLine bad(static_cast<std::uint64_t>(seed));
    ScriptedLine line([&bad](const std::string& request) { return bad(request); });
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) * 77);
    DeviceLink* devices[] = {&line.master().add_device(16), &line.master().add_device(17),
                             &line.master().add_device(40)};
    std::map<std::pair<std::uint8_t, RequestId>, int> open;
    int number = 0;
    for (int step = 0; step < 400; ++step) {
      DeviceLink& device = *devices[below(random, 3)];
      const std::uint8_t address = device.address();
      ++number;
      RequestId id = kNoRequest;
      switch (step < 300 ? below(random, 3) : 3u) {
        case 0:
          id = device.request(rrg_request(address, number));
          break;
        case 1:
          id = device.request(wri_request(address, static_cast<std::uint16_t>(number), 7));
          break;
        case 2:
          id = device.offer_bulk(imw_request(address, number, 0, 0, 0), line.now());
          break;
        default:
          break;
      }
      if (id != kNoRequest) open[{address, id}] = number;
      line.run_for((step < 300 ? below(random, 60) : 200) * kMs);
      for (DeviceLink* d : devices) {
        for (const Outcome& outcome : take_all(*d)) {
          const auto at = open.find({d->address(), outcome.id});
          ASSERT_NE(at, open.end()) << "seed " << seed;
          check_outcome(bad, outcome, at->second, outcome.request.command != Command::IMW);
          open.erase(at);
          accepted += outcome.accepted() ? 1 : 0;
          unknown += outcome.unknown() ? 1 : 0;
        }
      }
      if (HasFailure()) FAIL() << "seed " << seed << ", step " << step;
    }
    EXPECT_TRUE(open.empty()) << "seed " << seed;
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(unknown, 100);
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
