#include <gtest/gtest.h>

#include "protocol/silverlode/scripted_line.h"

namespace interpolated_motion::silverlode::test {
namespace {

constexpr double kC = kCharacterUs;

/// The first answers as given, then those of a drive that is well.
ScriptedLine::Script answers_then_healthy(std::vector<std::vector<Answer>> first) {
  return [first, n = std::size_t{0}](const std::string& request) mutable {
    return n < first.size() ? first[n++] : healthy(request);
  };
}

TEST(LineFailure, SilenceEndsInTimeOutsAndRepeats) {
  ScriptedLine line(silent);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(ris_request(16));
  line.run_for(1000 * kMs);
  // 7 characters out, 15 of the longest reply, 20 ms; then 10 ms of silence.
  const double timeout = 22 * kC + 20000;
  ASSERT_EQ(line.sent().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(to_us(line.sent()[i].begin), static_cast<double>(i) * (timeout + 10000), 1) << i;
  }
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::NoReply);
  EXPECT_TRUE(outcomes[0].unknown());
  EXPECT_EQ(outcomes[0].attempts, 4);
  EXPECT_NEAR(to_us(outcomes[0].reply_end), 3 * (timeout + 10000) + timeout, 1);
  EXPECT_EQ(drive.statistics().timeouts, 4u);
  EXPECT_EQ(drive.statistics().repeats, 3u);
  EXPECT_EQ(drive.statistics().sent, 4u);
  EXPECT_EQ(drive.text(outcomes[0]), "line0 address 16: RIS \"@16 20\" no reply to 4 attempts");
}

TEST(LineFailure, RepeatedRequestIsAnswered) {
  ScriptedLine line(answers_then_healthy({{}, {{"# 10 0014 00Z3\r"}}}));
  DeviceLink& drive = line.master().add_device(16);
  drive.request(ris_request(16));
  line.run_for(1000 * kMs);
  ASSERT_EQ(line.sent().size(), 3u);
  const double second = 22 * kC + 20000 + 10000;
  EXPECT_NEAR(to_us(line.sent()[1].begin), second, 1);
  EXPECT_NEAR(to_us(line.sent()[2].begin), second + 7 * kC + 2000 + 15 * kC + 10000, 1);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].word(), 0x00F3);
  EXPECT_EQ(outcomes[0].attempts, 3);
}

TEST(LineFailure, LatestReplyInTimeIsTaken) {
  ScriptedLine line(answers_then_healthy({{{"# 10 0014 00F3\r", 20 * kMs - 2 * kUs}}}));
  DeviceLink& drive = line.master().add_device(16);
  drive.request(ris_request(16));
  line.run_for(200 * kMs);
  EXPECT_EQ(line.sent().size(), 1u);
  EXPECT_EQ(take_all(drive).at(0).kind, OutcomeKind::Data);
}

// Whatever befalls IMW and IMS, they go on the line once and the caller is told that it does not know.
TEST(LineFailure, WhatAddsUpIsNeverSentTwice) {
  const std::vector<Answer> mishaps[] = {
      {},                      // nothing
      {{"* 1\r"}},             // garbled
      {{"* 1"}},               // truncated
      {{"* 11\r"}},            // another address
      {{"# 10 000C 0001\r"}},  // another command
      {{"* 10\r", 26 * kMs}},  // late
      {{std::string(500, 'x') + "\r"}},
  };
  for (const auto& mishap : mishaps) {
    for (const Request& request : {imw_request(16, 1, 2, 3, 4), ims_request(16)}) {
      for (const bool bulk : {false, true}) {
        ScriptedLine line(answers_then_healthy({mishap}));
        DeviceLink& drive = line.master().add_device(16);
        bulk ? drive.offer_bulk(request, kNever) : drive.request(request);
        line.run_for(1000 * kMs);
        EXPECT_EQ(line.sent().size(), 1u);
        const std::vector<Outcome> outcomes = take_all(drive);
        ASSERT_EQ(outcomes.size(), 1u);
        EXPECT_TRUE(outcomes[0].unknown());
        EXPECT_FALSE(outcomes[0].accepted());
        EXPECT_EQ(outcomes[0].attempts, 1);
      }
    }
  }
}

// The ACK of a segment comes after its time-out, the next request is lost on its way: it must not seem
// acknowledged.
TEST(LineFailure, LateReplyIsNotTheAnswerOfTheNextRequest) {
  LineParameters parameters;
  parameters.repeats = 0;
  ScriptedLine line(answers_then_healthy({{{"* 10\r", 25 * kMs}}, {}}), parameters);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(imw_request(16, 1, 2, 3, 4));
  drive.request(emd_request(16));
  line.run_for(1000 * kMs);

  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::NoReply);
  EXPECT_EQ(outcomes[1].kind, OutcomeKind::NoReply);
  // 15 characters, 25 ms, 5 characters of late ACK, and 10 ms of silence.
  EXPECT_NEAR(to_us(line.sent().at(1).begin), 15 * kC + 25000 + 5 * kC + 10000, 1);
  EXPECT_EQ(line.master().unexpected(UnexpectedLine::NoRequest).count, 1u);
  EXPECT_EQ(line.master().unexpected_text(UnexpectedLine::NoRequest),
            "line0: a reply that no request waits for came once, last \"* 10\" after \"@16 25 1 2 3 4\"");
}

// The time-out cuts a reply in two: neither half is a reply, and the line is left alone until it is over.
TEST(LineFailure, ReplyAcrossTheTimeOut) {
  ScriptedLine line(answers_then_healthy({{{"# 10 0014 00F3\r", 21 * kMs}}}));
  DeviceLink& drive = line.master().add_device(16);
  drive.request(ris_request(16));
  line.run_for(200 * kMs);
  ASSERT_EQ(line.sent().size(), 2u);
  EXPECT_NEAR(to_us(line.sent()[1].begin), 22 * kC + 21000 + 10000, 1);
  EXPECT_EQ(line.master().unexpected(UnexpectedLine::Truncated).count, 1u);
  EXPECT_EQ(line.master().unexpected(UnexpectedLine::Malformed).count, 1u);
  EXPECT_EQ(take_all(drive).at(0).word(), 0x00F3);
}

TEST(LineFailure, ReplyOfAnotherAddressIsIgnored) {
  ScriptedLine line(answers_then_healthy({{{"* 12\r", 1 * kMs}, {"* 10\r", 5 * kMs}}}));
  DeviceLink& drive = line.master().add_device(16);
  line.master().add_device(18);
  drive.request(emd_request(16));
  line.run_for(200 * kMs);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::Acknowledged);
  EXPECT_NEAR(to_us(outcomes[0].reply_begin), 8 * kC + 5000, 1);
  EXPECT_EQ(line.sent().size(), 1u);
  EXPECT_EQ(
      line.master().unexpected_text(UnexpectedLine::WrongAddress),
      "line0: a reply of another address than the one asked came once, last \"* 12\" after \"@16 227\"");
}

TEST(LineFailure, WrongEchoKindAndLengthAreIgnored) {
  for (const char* wrong : {"# 10 0015 00F3\r", "* 10\r", "# 10 0014 00F3 0000\r", "! 10 0015 0005\r"}) {
    ScriptedLine line(answers_then_healthy({{{wrong, 1 * kMs}, {"# 10 0014 1234\r", 8 * kMs}}}));
    DeviceLink& drive = line.master().add_device(16);
    drive.request(ris_request(16));
    line.run_for(200 * kMs);
    const std::vector<Outcome> outcomes = take_all(drive);
    ASSERT_EQ(outcomes.size(), 1u) << wrong;
    EXPECT_EQ(outcomes[0].word(), 0x1234) << wrong;
    EXPECT_EQ(line.master().unexpected(UnexpectedLine::WrongEcho).count, 1u) << wrong;
    EXPECT_EQ(line.sent().size(), 1u) << wrong;
  }
}

TEST(LineFailure, DataIsNoAcknowledgement) {
  LineParameters parameters;
  parameters.repeats = 0;
  ScriptedLine line([](const std::string&) { return std::vector<Answer>{{"# 10 00E3 0000\r"}}; }, parameters);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  line.run_for(200 * kMs);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(drive.text(outcomes[0]),
            "line0 address 16: EMD \"@16 227\" no reply, but \"# 10 00E3 0000\" came");
}

TEST(LineFailure, NoiseBeforeTheReplyDoesNoHarm) {
  ScriptedLine line(answers_then_healthy({{{"\xFFz 0* 10\r"}}}));
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  line.run_for(200 * kMs);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::Acknowledged);
  EXPECT_EQ(outcomes[0].attempts, 1);
  EXPECT_NEAR(to_us(outcomes[0].reply_begin), 8 * kC + 2000 + 4 * kC, 1);
  EXPECT_EQ(line.master().dropped_characters(), 4u);
}

/// What is said of three replies in a row of address 17 that are garbled.
class GarbledReplies : public testing::Test {
 protected:
  GarbledReplies() { parameters_.repeats = 0; }

  static std::vector<Answer> answer(const std::string& request, bool all_garbled) {
    if (all_garbled || request.rfind("@17", 0) == 0) return {{"* 1\x11\r"}};
    return healthy(request);
  }

  std::vector<std::string> texts_of(ScriptedLine& line, DeviceLink& drive) {
    std::vector<std::string> texts;
    for (int i = 0; i < 3; ++i) {
      drive.request(hlt_request(17));
      line.run_for(100 * kMs);
      for (const Outcome& outcome : take_all(drive)) texts.push_back(drive.text(outcome));
    }
    return texts;
  }

  LineParameters parameters_;
};

TEST_F(GarbledReplies, OfTheOnlyDriveHaveSeveralCauses) {
  ScriptedLine line([](const std::string& request) { return answer(request, false); }, parameters_);
  DeviceLink& drive = line.master().add_device(17);
  const std::vector<std::string> texts = texts_of(line, drive);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[1], "line0 address 17: HLT \"@17 2\" garbled reply \"* 1\\x11\"");
  EXPECT_EQ(texts[2],
            texts[1] +
                "; 3 replies in a row were garbled: noise, another rate than buses/line0/baud, or two "
                "drives share address 17");
  EXPECT_EQ(drive.statistics().garbled, 3u);
}

TEST_F(GarbledReplies, OfOneAddressAloneTellOfTwoDrivesThatShareIt) {
  ScriptedLine line([](const std::string& request) { return answer(request, false); }, parameters_);
  DeviceLink& drive = line.master().add_device(17);
  DeviceLink& other = line.master().add_device(16);
  other.request(ris_request(16));
  const std::vector<std::string> texts = texts_of(line, drive);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[2],
            texts[1] +
                "; 3 replies in a row were garbled and none of other addresses: two drives may share "
                "address 17");
}

TEST_F(GarbledReplies, OfAllAddressesTellOfNoise) {
  ScriptedLine line([](const std::string& request) { return answer(request, true); }, parameters_);
  DeviceLink& drive = line.master().add_device(17);
  line.master().add_device(16).request(ris_request(16));
  const std::vector<std::string> texts = texts_of(line, drive);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_NE(texts[2].find("those of other addresses too: noise"), std::string::npos) << texts[2];
  EXPECT_EQ(texts[2].find("share address"), std::string::npos) << texts[2];
}

// 41 ms: later than the time-out of 20 ms and a silence of 10 ms, so it would fall into the next attempt.
TEST(LineFailure, ALateReplyToAPatientRequestIsRecognised) {
  ScriptedLine line([](const std::string&) { return std::vector<Answer>{{"* 10\r", 41 * kMs}}; });
  DeviceLink& drive = line.master().add_device(16);
  Request request = pol_request(16);
  request.patient = true;
  request.repeatable = false;
  drive.request(request);
  line.run_for(1000 * kMs);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::NoReply);
  EXPECT_NEAR(seconds(drive.statistics().late_by), 0.041, 1e-5);
  EXPECT_EQ(drive.text(outcomes[0]),
            "line0 address 16: POL \"@16 0\" no reply; a reply came 0.041 s after its request, too late by "
            "`reply_timeout` (0.020 s): raise buses/line0/reply_timeout");
}

TEST(LineFailure, ASecondReplyToOneRequestIsCounted) {
  ScriptedLine line([](const std::string&) {
    return std::vector<Answer>{{"* 10\r", 2 * kMs}, {"* 10\r", 4 * kMs}};
  });
  DeviceLink& drive = line.master().add_device(16);
  drive.request(emd_request(16));
  line.run_for(100 * kMs);
  EXPECT_EQ(take_all(drive).at(0).kind, OutcomeKind::Acknowledged);
  EXPECT_EQ(drive.statistics().second_replies, 1u);
}

TEST(LineFailure, UnaskedCharactersKeepTheLineSilent) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  line.inject("* 1", at_us(1000));
  line.run_until(at_us(1000 + 3 * kC + 10));
  drive.request(emd_request(16));
  line.run_for(100 * kMs);
  ASSERT_EQ(line.sent().size(), 1u);
  EXPECT_NEAR(to_us(line.sent()[0].begin), 1000 + 3 * kC + 10000, 1);
  EXPECT_EQ(take_all(drive).at(0).kind, OutcomeKind::Acknowledged);
}

// A line that never falls silent must not keep a stop from its drive.
TEST(LineFailure, EndlessNoiseDelaysARequestTenGuardsAtMost) {
  ScriptedLine line(silent);
  DeviceLink& drive = line.master().add_device(16);
  line.inject(std::string(5000, 'x'), at_us(50000));
  line.run_until(at_us(55000));
  drive.request(stp_request(16, -1));
  line.run_until(at_us(400000));
  ASSERT_GE(line.sent().size(), 1u);
  EXPECT_NEAR(to_us(line.sent()[0].begin), 50000 + kC + 100000, 1);
}

TEST(LineFailure, DroppingEndsTheRepeats) {
  ScriptedLine line(silent);
  DeviceLink& drive = line.master().add_device(16);
  drive.request(ris_request(16));
  line.run_until(at_us(1000));
  drive.drop_requests();  // on the line
  line.run_for(500 * kMs);
  EXPECT_EQ(line.sent().size(), 1u);
  EXPECT_EQ(take_all(drive).at(0).kind, OutcomeKind::NoReply);

  drive.request(ris_request(16));
  line.run_for(28 * kMs);  // waits to be repeated
  EXPECT_EQ(drive.pending(), 1u);
  drive.drop_requests();
  EXPECT_EQ(drive.pending(), 0u);
  line.run_for(500 * kMs);
  EXPECT_EQ(line.sent().size(), 2u);
  const std::vector<Outcome> outcomes = take_all(drive);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].kind, OutcomeKind::NoReply);
  EXPECT_EQ(outcomes[0].attempts, 1);
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
