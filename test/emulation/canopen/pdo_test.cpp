#include <gtest/gtest.h>

#include "wire_host.h"

// PDOs of CiA 301, 7.2.2, at the wire.
namespace interpolated_motion::emulation {
namespace {

struct Pdo : testing::Test {
  WireHost host;
  void SetUp() override { host.boot(); }

  void set_up(unsigned pdo, unsigned id, unsigned type, std::initializer_list<unsigned> mapping) {
    const unsigned communication = 0x1800 + pdo;
    ASSERT_EQ(host.write(communication, 1, 0x80000000U | id, 4), 0U);
    ASSERT_EQ(host.write(communication, 2, type, 1), 0U);
    ASSERT_EQ(host.write(0x1A00 + pdo, 0, 0, 1), 0U);
    unsigned entry = 0;
    for (const unsigned object : mapping) ASSERT_EQ(host.write(0x1A00 + pdo, ++entry, object, 4), 0U);
    ASSERT_EQ(host.write(0x1A00 + pdo, 0, entry, 1), 0U);
    ASSERT_EQ(host.write(communication, 1, id, 4), 0U);
  }
};

TEST_F(Pdo, MappingRulesHaveTheirAbortCodes) {
  EXPECT_EQ(host.write(0x1400, 1, 0x222, 4), 0x06040043U) << "COB-ID changed while valid";
  EXPECT_EQ(host.write(0x1600, 0, 0, 1), 0x06040043U) << "mapping changed while valid";
  ASSERT_EQ(host.write(0x1400, 1, 0x80000201, 4), 0U);
  EXPECT_EQ(host.write(0x1600, 1, 0x20C10040, 4), 0x06040043U)
      << "entries are changed while sub-index 0 is 0 only";
  ASSERT_EQ(host.write(0x1600, 0, 0, 1), 0U);
  EXPECT_EQ(host.write(0x1600, 1, 0x60410010, 4), 0x06040041U) << "read only into a receive PDO";
  EXPECT_EQ(host.write(0x1600, 1, 0x60400008, 4), 0x06040041U) << "wrong length";
  EXPECT_EQ(host.write(0x1600, 1, 0x607D0120, 4), 0x06040041U) << "not mappable";
  EXPECT_EQ(host.write(0x1600, 1, 0x60C10120, 4), 0x06020000U) << "no such object";
  ASSERT_EQ(host.write(0x1600, 1, 0x20C10040, 4), 0U);
  ASSERT_EQ(host.write(0x1600, 2, 0x60400010, 4), 0U);
  EXPECT_EQ(host.write(0x1600, 0, 2, 1), 0x06040042U) << "80 bits";
  EXPECT_EQ(host.write(0x1600, 0, 9, 1), 0x06090031U);
  EXPECT_EQ(host.write(0x1600, 0, 1, 1), 0U);
  EXPECT_EQ(host.write(0x1400, 2, 241, 1), 0x06090030U) << "reserved transmission type";
  EXPECT_EQ(host.write(0x1800, 3, 20, 2), 0x06040043U) << "inhibit time of a valid PDO";
  host.nmt(1);
  EXPECT_EQ(host.write(0x1400, 1, 0x201, 4), 0x0F00FFC0U) << "wrong NMT state";
}

TEST_F(Pdo, FreeRecordsMayBeMappedWhenTheSettingSaysSo) {
  EposParameters parameters;
  parameters.free_records_pdo_mappable = false;
  WireHost strict(parameters);
  strict.boot();
  for (WireHost* h : {&host, &strict}) {
    ASSERT_EQ(h->write(0x1A03, 0, 0, 1), 0U);
    EXPECT_EQ(h->write(0x1A03, 1, 0x60C40220, 4), h == &host ? 0U : 0x06040041U);
  }
}

TEST_F(Pdo, ReceivePdosWorkInOperationalOnly) {
  host.send(0x201, {0x06, 0});
  EXPECT_EQ(host.status(), 0x0140U);
  host.nmt(1);
  host.send(0x201, {0x06, 0});
  EXPECT_EQ(host.status(), 0x0321U);
  host.send(0x301, {0x0F, 0, 7});
  EXPECT_EQ(host.status(), 0x0737U);
  EXPECT_EQ(host.read(0x6061, 0), 7U);
}

TEST_F(Pdo, TooShortIsReportedAndIgnoredLongerIsTaken) {
  host.nmt(1);
  host.send(0x201, {0x06});
  host.run(ms(1));
  const auto emergency = host.take(0x081);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x10, 0x82, 0x11, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.status(), 0x0340U);
  host.send(0x201, {0x06, 0x00, 0xFF, 0xFF});
  EXPECT_EQ(host.status(), 0x0321U);
}

TEST_F(Pdo, EventPdoSendsOnChangeNoMoreOftenThanItsInhibitTime) {
  ASSERT_EQ(host.write(0x1800, 1, 0xC0000181, 4), 0U);
  ASSERT_EQ(host.write(0x1800, 3, 100, 2), 0U);  // 10 ms
  ASSERT_EQ(host.write(0x1800, 1, 0x40000181, 4), 0U);
  host.nmt(1);
  host.run(ms(5));
  ASSERT_EQ(host.count(0x181), 1U) << "once on entering Operational";
  EXPECT_EQ(bytes_of(host.take(0x181)->frame), (Bytes{0x40, 0x03}));
  host.run(ms(50));
  EXPECT_EQ(host.count(0x181), 0U);
  host.send(0x201, {0x06, 0});
  host.run(ms(2));
  const auto first = host.take(0x181);
  ASSERT_TRUE(first);
  EXPECT_EQ(bytes_of(first->frame), (Bytes{0x21, 0x03}));
  host.send(0x201, {0x07, 0});
  host.run(ms(2));
  host.send(0x201, {0x0F, 0});
  host.run(ms(20));
  const auto second = host.take(0x181);
  ASSERT_TRUE(second);
  EXPECT_EQ(bytes_of(second->frame), (Bytes{0x37, 0x07})) << "the state between was inhibited";
  EXPECT_NEAR(seconds(second->time - first->time), 0.010, 1e-5);
  EXPECT_EQ(host.count(0x181), 0U);
}

TEST_F(Pdo, SynchronousTransmission) {
  set_up(0, 0x181, 3, {0x60640020, 0x60410010});
  set_up(1, 0x281, 0, {0x60610008});
  host.nmt(1);
  for (int i = 0; i < 9; ++i) {
    host.send(0x080, {});
    host.run(ms(2));
  }
  EXPECT_EQ(host.count(0x181), 3U);
  EXPECT_EQ(host.count(0x281), 1U) << "type 0: only after a change";
  ASSERT_EQ(host.write(0x6060, 0, 3, 1), 0U);
  EXPECT_EQ(host.count(0x281), 1U);
  host.send(0x080, {});
  host.run(ms(2));
  host.take(0x281);
  const auto changed = host.take(0x281);
  ASSERT_TRUE(changed);
  EXPECT_EQ(bytes_of(changed->frame), (Bytes{3}));
  EXPECT_EQ(host.take(0x181)->frame.length, 6);
}

TEST_F(Pdo, RemoteRequests) {
  set_up(3, 0x481, 253, {0x60C40220});
  set_up(2, 0x381, 252, {0x60610008});
  host.nmt(1);
  host.send(0x080, {});
  host.run(ms(5));
  EXPECT_EQ(host.count(0x481) + host.count(0x381), 0U);
  ASSERT_EQ(host.write(0x6060, 0, 3, 1), 0U);
  host.send(make_remote(0x481, 4));
  host.send(make_remote(0x381, 1));
  host.send(make_remote(0x181, 2));
  host.run(ms(2));
  EXPECT_EQ(bytes_of(host.take(0x481)->frame), (Bytes{64, 0, 0, 0}));
  EXPECT_EQ(bytes_of(host.take(0x381)->frame), (Bytes{1})) << "value of the last SYNC";
  host.take(0x181);
  EXPECT_EQ(host.count(0x181), 0U) << "bit 30 forbids requests";
}

TEST_F(Pdo, SynchronousReceivePdoWaitsForSync) {
  ASSERT_EQ(host.write(0x1400, 2, 1, 1), 0U);
  host.nmt(1);
  host.send(0x201, {0x06, 0});
  EXPECT_EQ(host.status(), 0x0340U);
  host.send(0x080, {});
  EXPECT_EQ(host.status(), 0x0321U);
}

TEST_F(Pdo, DefaultCobIdsComeBack) {
  ASSERT_EQ(host.write(0x1401, 1, 0x80000345, 4), 0U);
  ASSERT_EQ(host.write(0x1011, 5, 0x64616F6C, 4), 0U);
  EXPECT_EQ(host.read(0x1401, 1), 0x301U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
