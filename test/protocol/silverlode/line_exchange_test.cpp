#include <gtest/gtest.h>

#include <stdexcept>

#include "protocol/silverlode/scripted_line.h"

namespace interpolated_motion::silverlode::test {
namespace {

constexpr double kC = kCharacterUs;

Outcome single_outcome(DeviceLink& device) {
  const std::vector<Outcome> outcomes = take_all(device);
  EXPECT_EQ(outcomes.size(), 1u);
  return outcomes.empty() ? Outcome() : outcomes[0];
}

TEST(LineExchange, TimesOfARegisterRead) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  line.run_until(at_us(1000));
  const RequestId id = drive.request(rrg_request(16, 1));
  line.run_for(100 * kMs);

  const Outcome outcome = single_outcome(drive);
  EXPECT_EQ(outcome.id, id);
  EXPECT_EQ(outcome.kind, OutcomeKind::Data);
  EXPECT_EQ(outcome.register_value(), 92000);
  EXPECT_FALSE(outcome.register_value(1));
  EXPECT_EQ(outcome.attempts, 1);
  // 9 characters of request, 2 ms, 20 characters of reply.
  EXPECT_NEAR(to_us(line.sent().at(0).begin), 1000, 1);
  EXPECT_NEAR(to_us(outcome.request_end), 1000 + 9 * kC, 1);
  EXPECT_NEAR(to_us(outcome.reply_begin), 1000 + 9 * kC + 2000, 1);
  EXPECT_NEAR(to_us(outcome.reply_end), 1000 + 9 * kC + 2000 + 20 * kC, 1);
  EXPECT_EQ(drive.text(outcome), "line0 address 16: RRG \"@16 12 1\" answered 0001 6760");
}

TEST(LineExchange, BudgetIsWhatTheLineTakes) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  const Request requests[] = {wri_request(16, 19, 1073742), rrg_request(16, 1), ris_request(16),
                              imq_request(16), imw_request(16, 4000, 1073741824, 1073742, 536870912)};
  for (const Request& request : requests) ASSERT_NE(drive.request(request), kNoRequest);
  line.run_for(1000 * kMs);

  ASSERT_EQ(line.sent().size(), 5u);
  for (std::size_t i = 0; i + 1 < 5; ++i) {
    const HostDuration taken = line.sent()[i + 1].begin - line.sent()[i].begin;
    EXPECT_NEAR(seconds(taken) * 1e6, seconds(line.master().exchange_time(requests[i])) * 1e6, 1) << i;
  }
  // The figure of the vendor's line: 41 characters of IMW and 5 of ACK at 57600 bit/s, 11 bits each, and 2
  // ms.
  EXPECT_NEAR(seconds(line.master().exchange_time(requests[4])), 46 * 11 / 57600.0 + 0.002, 1e-6);
  EXPECT_NEAR(seconds(line.master().longest_exchange_time(requests[4])), 56 * 11 / 57600.0 + 0.030, 1e-6);
  for (const Outcome& outcome : take_all(drive)) EXPECT_TRUE(outcome.accepted());
}

TEST(LineExchange, PauseBetweenReplyAndRequest) {
  LineParameters parameters;
  parameters.pause = 3 * kMs;
  ScriptedLine line(healthy, parameters);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  drive.request(emd_request(16));
  line.run_for(100 * kMs);
  ASSERT_EQ(line.sent().size(), 2u);
  EXPECT_NEAR(to_us(line.sent()[1].begin), 8 * kC + 2000 + 5 * kC + 3000, 1);
}

TEST(LineExchange, PollIsAnsweredEitherWay) {
  bool idle = true;
  ScriptedLine line(
      [&idle](const std::string&) { return std::vector<Answer>{{idle ? "* 10\r" : "# 10 0000 2000\r"}}; });
  DeviceLink& drive = line.master().add_device(16);
  drive.request(pol_request(16));
  line.run_for(50 * kMs);
  EXPECT_EQ(single_outcome(drive).polling_status(), 0x0000);
  idle = false;
  drive.request(pol_request(16));
  line.run_for(50 * kMs);
  EXPECT_EQ(single_outcome(drive).polling_status(), 0x2000);
}

TEST(LineExchange, FixedPollEchoesItselfOrThePoll) {
  for (const char* reply : {"# 10 001B 2000\r", "# 10 0000 2000\r"}) {
    ScriptedLine line([reply](const std::string&) { return std::vector<Answer>{{reply}}; });
    DeviceLink& drive = line.master().add_device(16);
    drive.request(por_request(16));
    line.run_for(50 * kMs);
    EXPECT_EQ(single_outcome(drive).polling_status(), 0x2000) << reply;
  }
}

TEST(LineExchange, RefusalsOfEveryCode) {
  for (unsigned code = 0; code <= 11; ++code) {
    char reply[20];
    std::snprintf(reply, sizeof reply, "! 11 0019 %04X\r", code);
    ScriptedLine line([&reply](const std::string&) { return std::vector<Answer>{{reply}}; });
    DeviceLink& drive = line.master().add_device(17);
    drive.request(imw_request(17, 1, 2, 3, 4));
    line.run_for(300 * kMs);
    const Outcome outcome = single_outcome(drive);
    EXPECT_EQ(outcome.kind, OutcomeKind::Refused);
    EXPECT_TRUE(outcome.refused_with(NakCode{static_cast<std::uint16_t>(code)}));
    EXPECT_FALSE(outcome.unknown());
    EXPECT_EQ(drive.statistics().refused[code <= 10 ? code : 0], 1u);
    EXPECT_EQ(line.sent().size(), 1u) << "a refusal is an answer";
  }
}

TEST(LineExchange, TextOfARefusal) {
  ScriptedLine line([](const std::string&) { return std::vector<Answer>{{"! 11 0019 0006\r"}}; });
  DeviceLink& drive = line.master().add_device(17);
  drive.request(imw_request(17, 4000, 1073741824, 0, 5));
  line.run_for(50 * kMs);
  EXPECT_EQ(drive.text(single_outcome(drive)),
            "line0 address 17: IMW \"@17 25 4000 1073741824 0 5\" refused, NAK 6 (buffer full)");
}

TEST(LineExchange, RestartIsNotAnswered) {
  ScriptedLine line(silent);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(rst_request(16));
  drive.request(hlt_request(16));
  line.run_until(at_us(15000));
  EXPECT_EQ(single_outcome(drive).kind, OutcomeKind::Sent);
  ASSERT_EQ(line.sent().size(), 2u);
  EXPECT_NEAR(to_us(line.sent()[1].begin), 6 * kC + 10000, 1);
}

TEST(LineExchange, BroadcastGoesFirstAndIsFollowedBySilence) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  ASSERT_NE(line.master().broadcast(stp_request(kGlobalAddress, -1)), kNoRequest);
  EXPECT_EQ(line.master().broadcast(stp_request(16, -1)), kNoRequest);
  line.run_for(100 * kMs);
  ASSERT_EQ(line.sent_texts(), (std::vector<std::string>{"@255 3 -1", "@16 227"}));
  EXPECT_NEAR(to_us(line.sent()[1].begin), 10 * kC + 10000, 1);
  EXPECT_NEAR(seconds(line.master().exchange_time(stp_request(kGlobalAddress, -1))) * 1e6, 10 * kC + 10000,
              1);
}

TEST(LineExchange, BroadcastTellsWhenItWasOnTheLine) {
  ScriptedLine line(healthy);
  const RequestId first = line.master().broadcast(stp_request(kGlobalAddress, -1));
  const RequestId second = line.master().broadcast(dmd_request(kGlobalAddress));
  ASSERT_NE(first, kNoRequest);
  ASSERT_NE(second, first);
  EXPECT_FALSE(line.master().broadcast_end(first)) << "it has not left";
  line.run_for(5 * kMs);
  ASSERT_TRUE(line.master().broadcast_end(first));
  EXPECT_NEAR(to_us(*line.master().broadcast_end(first)), 10 * kC, 1) << "@255 3 -1 and CR";
  EXPECT_FALSE(line.master().broadcast_end(second));
  line.run_for(100 * kMs);
  ASSERT_TRUE(line.master().broadcast_end(second));
  EXPECT_NEAR(to_us(*line.master().broadcast_end(second)), 10 * kC + 10000 + 9 * kC, 1)
      << "after the silence";
  EXPECT_FALSE(line.master().broadcast_end(first)) << "only the last is known";
  EXPECT_FALSE(line.master().broadcast_end(kNoRequest));
}

// A two-wire line brings back what the host sends.
TEST(LineExchange, OwnEchoIsNoAnswer) {
  LineParameters parameters;
  ScriptedLine line(
      [](const std::string& request) {
        const HostDuration request_length =
            host_duration(static_cast<double>(request.size() + 1) * kCharacterUs * 1e-6);
        return std::vector<Answer>{{request + "\r", -request_length}, {healthy_reply(request)}};
      },
      parameters);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  drive.request(rrg_request(16, 1));
  line.run_for(100 * kMs);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::Acknowledged);
  EXPECT_EQ(outcomes[1].register_value(), 92000);
  EXPECT_EQ(line.master().echoes(), 2u);
  EXPECT_EQ(line.sent().size(), 2u);
}

TEST(LineExchange, RequestsNotTaken) {
  LineParameters parameters;
  parameters.request_capacity = 3;
  ScriptedLine line(healthy, parameters);
  DeviceLink& drive = line.master().add_device(16);
  EXPECT_EQ(drive.request(emd_request(17)), kNoRequest) << "another address";
  EXPECT_NE(drive.offer_bulk(imw_request(16, 1, 2, 3, 4), kNever), kNoRequest);
  EXPECT_EQ(drive.offer_bulk(imw_request(16, 1, 2, 3, 4), kNever), kNoRequest) << "one waits already";
  EXPECT_NE(drive.request(emd_request(16)), kNoRequest);
  EXPECT_NE(drive.request(emd_request(16)), kNoRequest);
  EXPECT_EQ(drive.request(emd_request(16)), kNoRequest);
  EXPECT_EQ(drive.pending(), 3u);
  line.run_for(100 * kMs);
  EXPECT_EQ(drive.pending(), 0u);
  EXPECT_EQ(drive.request(emd_request(16)), kNoRequest) << "there is no room for its outcome";
  EXPECT_EQ(take_all(drive).size(), 3u);
  EXPECT_NE(drive.request(emd_request(16)), kNoRequest);
}

TEST(LineExchange, DroppedRequestsNeverReachTheLine) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  drive.request(cis_request(16));
  drive.offer_bulk(imw_request(16, 1, 2, 3, 4), kNever);
  const RequestId broadcast = line.master().broadcast(dmd_request(kGlobalAddress));
  line.master().clear_outgoing();
  line.run_for(100 * kMs);
  EXPECT_TRUE(line.sent().empty());
  EXPECT_FALSE(line.master().broadcast_end(broadcast));
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 3u);
  for (const Outcome& outcome : outcomes) {
    EXPECT_EQ(outcome.kind, OutcomeKind::Dropped);
    EXPECT_FALSE(outcome.unknown());
  }
}

TEST(LineExchange, WithdrawnBulkRequestHasNoOutcome) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  drive.offer_bulk(imw_request(16, 1, 2, 3, 4), kNever);
  EXPECT_TRUE(drive.bulk_waits());
  EXPECT_TRUE(drive.withdraw_bulk());
  EXPECT_FALSE(drive.withdraw_bulk());
  line.run_for(100 * kMs);
  EXPECT_TRUE(line.sent().empty());
  EXPECT_TRUE(take_all(drive).empty());
}

TEST(LineExchange, ConfigurationIsChecked) {
  const auto refused = [](void (*change)(LineParameters&)) {
    LineParameters parameters;
    change(parameters);
    EXPECT_THROW(LineMaster("line0", parameters), std::invalid_argument);
  };
  refused([](LineParameters& p) { p.baud = 299; });
  refused([](LineParameters& p) { p.baud = 250001; });
  refused([](LineParameters& p) { p.bits_per_character = 9; });
  refused([](LineParameters& p) { p.turnaround = -kMs; });
  refused([](LineParameters& p) { p.reply_timeout = 1 * kMs; });
  refused([](LineParameters& p) { p.guard = 11000 * kMs; });
  refused([](LineParameters& p) { p.pause = -kMs; });
  refused([](LineParameters& p) { p.repeats = -1; });
  refused([](LineParameters& p) { p.request_capacity = 1; });
  LineMaster master("line0");
  master.add_device(1);
  EXPECT_THROW(master.add_device(1), std::invalid_argument);
  EXPECT_THROW(master.add_device(0), std::invalid_argument);
  EXPECT_THROW(master.add_device(255), std::invalid_argument);
  try {
    LineParameters parameters;
    parameters.baud = 1;
    const LineMaster master7("line7", parameters);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "line7: baud = 1 is not in 300..250000");
  }
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
