#include <cstdint>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "protocol/canopen/bytes.h"
#include "protocol/canopen/drain.h"

// Listening before talking, and who else is on the bus.
namespace interpolated_motion::canopen::test {
namespace {

using namespace std::chrono_literals;

ReceivedFrame foreign(const Frame& frame, HostTime time) { return {frame, time, false}; }

MasterParameters listening(HostDuration listen) {
  MasterParameters parameters;
  parameters.heartbeat_period = 100ms;
  parameters.sync_period = 10ms;
  parameters.listen = listen;
  return parameters;
}

/// What `master` has sent from `from` to `to`, polled every ms.
std::size_t sent(Master& master, int from, int to) {
  std::size_t frames = 0;
  for (int ms = from; ms < to; ++ms) {
    master.poll(at_ms(ms));
    frames += drain(master, at_ms(ms)).size();
  }
  return frames;
}

TEST(ListenBeforeTalking, NothingIsSentBeforeTheBusHasBeenQuietForSoLong) {
  Master master("can0", listening(200ms));
  EXPECT_EQ(sent(master, 0, 200), 0u);
  EXPECT_TRUE(master.request_sync(at_ms(199)));
  EXPECT_GT(sent(master, 200, 230), 2u);
}

TEST(ListenBeforeTalking, AnotherMasterIsWaitedFor) {
  Master master("can0", listening(200ms));
  EXPECT_EQ(sent(master, 0, 150), 0u);
  master.on_frame(foreign(make_frame(0x080, {}), at_ms(150)));
  EXPECT_EQ(sent(master, 150, 350), 0u);
  EXPECT_GT(sent(master, 350, 380), 2u);
  EXPECT_EQ(master.foreign().of_master(), 1u);
  EXPECT_EQ(master.foreign().master_text(), "SYNC, 080#");
}

// A master that talks has drives that rely on it.
TEST(ListenBeforeTalking, WhoTalksGoesOn) {
  Master master("can0", listening(200ms));
  sent(master, 0, 300);
  master.on_frame(foreign(make_frame(0x080, {}), at_ms(300)));
  EXPECT_GT(sent(master, 300, 400), 10u);
  EXPECT_FALSE(master.foreign().quiet(at_ms(400)));
  EXPECT_TRUE(master.foreign().quiet(at_ms(500)));
}

TEST(ListenBeforeTalking, BusThatWasDownWasNotListenedTo) {
  Master master("can0", listening(200ms));
  sent(master, 0, 150);
  master.clear_outgoing();
  EXPECT_EQ(sent(master, 150, 350), 0u);
  EXPECT_GT(sent(master, 350, 380), 2u);
}

TEST(ListenBeforeTalking, WakesItselfUp) {
  Master master("can0", listening(200ms));
  master.poll(at_ms(5));
  EXPECT_EQ(master.next_deadline(), at_ms(205));
}

TEST(OtherMasterOnTheBus, IsWhoeverSendsWhatOnlyAMasterSends) {
  Master master("can0");
  master.add_node(3);
  std::uint64_t expected = 0;
  for (const Frame& frame :
       {make_frame(0x000, {0x80, 9}), make_frame(0x080, {}), make_frame(0x203, {1}), make_frame(0x503, {1}),
        make_frame(0x603, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0}), make_frame(0x77F, {5})}) {
    master.on_frame(foreign(frame, at_ms(1)));
    EXPECT_EQ(master.foreign().of_master(), ++expected) << to_string(frame);
  }
  for (const Frame& frame :
       {make_frame(0x100, {0, 0, 0, 0, 0, 0}), make_frame(0x209, {1}), make_frame(0x609, {0x40}),
        make_frame(0x189, {1}), make_frame(0x709, {5}), make_frame(0x7E5, {4}), make_frame(0x781, {1}),
        make_frame(0x703, {5}), make_frame(0x183, {1})}) {
    master.on_frame(foreign(frame, at_ms(2)));
    EXPECT_EQ(master.foreign().of_master(), expected) << to_string(frame);
  }
}

// Where this host sets the drives' clocks, nobody else may.
TEST(OtherMasterOnTheBus, IsWhoSendsTheTimeToDrivesThatSetTheirClocksByThisHost) {
  MasterParameters parameters;
  parameters.time_stamp_period = 1;
  Master master("can0", parameters);
  master.add_node(3);
  EXPECT_FALSE(master.foreign().master_sets_clocks());
  master.on_frame(foreign(make_frame(0x100, {0, 0, 0, 0, 0, 0}), at_ms(1)));
  EXPECT_EQ(master.foreign().of_master(), 1u);
  EXPECT_TRUE(master.foreign().master_sets_clocks());
  master.on_frame(foreign(make_frame(0x080, {}), at_ms(2)));
  EXPECT_FALSE(master.foreign().master_sets_clocks());
}

TEST(OtherMasterOnTheBus, IsNotThisOne) {
  Master master("can0");
  master.add_node(3);
  for (const Frame& frame : {make_frame(0x000, {0x80, 3}), make_frame(0x080, {}), make_frame(0x203, {1}),
                             make_frame(0x603, {0x40}), make_frame(0x77F, {5})})
    master.on_frame({frame, at_ms(1), true});
  EXPECT_EQ(master.foreign().of_master(), 0u);
  EXPECT_FALSE(master.find_node(3)->take_foreign_nmt());
}

TEST(OtherMasterOnTheBus, TellsWhomItsNmtCommandsAreFor) {
  Master master("can0");
  NodeLink& three = master.add_node(3);
  NodeLink& four = master.add_node(4);
  master.on_frame(foreign(make_frame(0x000, {0x80, 3}), at_ms(1)));
  EXPECT_EQ(three.take_foreign_nmt(), NmtCommand::EnterPreOperational);
  EXPECT_FALSE(three.take_foreign_nmt());
  EXPECT_FALSE(four.take_foreign_nmt());
  master.on_frame(foreign(make_frame(0x000, {2, 0}), at_ms(2)));
  EXPECT_EQ(three.take_foreign_nmt(), NmtCommand::Stop);
  EXPECT_EQ(four.take_foreign_nmt(), NmtCommand::Stop);
  for (const Frame& frame :
       {make_frame(0x000, {0x80}), make_frame(0x000, {7, 3}), make_frame(0x000, {0x80, 5})})
    master.on_frame(foreign(frame, at_ms(3)));
  EXPECT_FALSE(three.take_foreign_nmt());
}

TEST(OtherMasterOnTheBus, CanBeAllowed) {
  MasterParameters parameters = listening(200ms);
  parameters.alone = false;
  Master master("can0", parameters);
  master.on_frame(foreign(make_frame(0x080, {}), at_ms(0)));
  EXPECT_GT(sent(master, 0, 30), 2u);
  EXPECT_EQ(master.foreign().of_master(), 0u);
}

TEST(AnswersThatNobodyAskedFor, AreCounted) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  const auto answer = [&](int at) {
    master.on_frame(foreign(make_frame(0x583, {0x4B, 0x41, 0x60, 0, 0x37, 2, 0, 0}), at_ms(at)));
  };
  node.sdo().start_upload({0x6041, 0}, at_ms(0));
  drain(master, at_ms(0));
  answer(1);
  EXPECT_EQ(node.sdo_answers().surplus(), 0u);
  answer(2);
  EXPECT_EQ(node.sdo_answers().surplus(), 1u);
  // The same when the next object has been asked for.
  node.sdo().start_upload({0x6061, 0}, at_ms(3));
  drain(master, at_ms(3));
  answer(4);
  master.on_frame(foreign(make_frame(0x583, {0x4F, 0x61, 0x60, 0, 7, 0, 0, 0}), at_ms(5)));
  EXPECT_EQ(node.sdo_answers().surplus(), 2u);
}

// After a time-out two answers may come to two requests; and another's request has an answer too.
TEST(AnswersThatNobodyAskedFor, AreNotThoseToASecondTry) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  const Frame answer = make_frame(0x583, {0x4B, 0x41, 0x60, 0, 0x37, 2, 0, 0});
  for (const std::int64_t asked : {0, 1000}) {
    node.sdo().start_upload({0x6041, 0}, at_ms(asked));
    drain(master, at_ms(asked));
    master.poll(at_ms(asked + 900));
    drain(master, at_ms(asked + 900));
  }
  master.on_frame(foreign(make_frame(0x603, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0}), at_ms(1950)));
  for (int i = 0; i < 3; ++i) master.on_frame(foreign(answer, at_ms(1960 + i)));
  EXPECT_EQ(node.sdo_answers().surplus(), 0u);
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
