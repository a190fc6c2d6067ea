#pragma once

#include <array>
#include <cstdint>

#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::emulation {

/// What the PDOs of a drive need of it.
class PdoOwner {
 public:
  virtual ~PdoOwner() = default;

  /// An object mapped into a receive PDO gets these bytes.
  virtual void pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) = 0;

  /// A receive PDO had fewer bytes than are mapped (EMCY 0x8210).
  virtual void pdo_too_short() = 0;

  /// Queues a transmit PDO; false when there is no room.
  virtual bool pdo_send(const canopen::Frame& frame) = 0;
};

/// The four receive and four transmit PDOs of a drive (CiA 301, 7.2.2; EPOS2: no event timer, no SYNC start
/// value).
///
/// Transmission types: receive 0..240 are applied at the next SYNC, others at once; transmit 0 at a SYNC
/// after a change, 1..240 at every n-th SYNC, 252 and 253 on request (252: with the values of the last SYNC),
/// 254 and 255 on a change, no more often than the inhibit time, and once on entering Operational. A transmit
/// PDO whose COB-ID permits it (bit 30 = 0) also answers requests.
class PdoEngine {
 public:
  static constexpr int kCount = 4;  ///< of each direction

  /// `setup_only_pre_operational`: while Operational no PDO parameter can be written.
  PdoEngine(ObjectDictionary& objects, bool setup_only_pre_operational, PdoOwner& owner)
      : objects_(objects), setup_only_pre_operational_(setup_only_pre_operational), owner_(owner) {}

  /// Whether the index belongs to PDO communication or mapping parameters.
  static bool concerns(std::uint16_t index);

  /// Rules for writing a PDO parameter that go beyond type and range.
  AbortCode check(ObjectDictionary::Slot slot, std::int64_t value, bool operational) const;

  /// To be called after PDO parameters have changed.
  void configure();

  /// Entering Operational: nothing has been sent or received yet.
  void start();

  /// A data frame; true when it was one of the receive PDOs.
  bool on_frame(const canopen::Frame& frame);
  /// A remote frame of any identifier: answered by the transmit PDO that has it and may be asked. Then SYNC.
  /// Both only while Operational.
  void on_remote_request(const canopen::Frame& frame);
  void on_sync();

  /// Sends what has changed; once per millisecond of the drive, `now_100us` in units of 100 us.
  void tick(std::int64_t now_100us);

 private:
  struct Mapped {
    ObjectDictionary::Slot slot = 0;  ///< of the object
    int bits = 0;                     ///< 8, 16, 32 or 64: whole objects only
  };

  struct Pdo {
    bool valid = false;           ///< bit 31 of the COB-ID is 0
    bool remote_allowed = false;  ///< bit 30 of the COB-ID is 0
    std::uint32_t id = 0;         ///< 11 bits
    std::uint8_t type = 255;      ///< transmission type
    int inhibit = 0;              ///< 100 us, of a transmit PDO
    int count = 0;                ///< objects mapped, 0..8
    int length = 0;               ///< bytes
    std::array<Mapped, 8> map{};  ///< the first `count`
    std::uint64_t data = 0;       ///< received last, byte 0 lowest; of type 252, sampled at the last SYNC
    std::uint64_t last = 0;       ///< sent last
    std::int64_t sent_at = 0;     ///< 100 us on the drive's clock; of types 254 and 255
    int syncs = 0;                ///< since it was sent, of types 1..240
    bool pending = false;         ///< receive: data waits for SYNC
    bool ever_sent = false;       ///< since the PDOs were set up, or the drive became Operational
  };

  Pdo compile(std::uint16_t communication, std::uint16_t mapping) const;
  AbortCode check_mapping_entry(std::uint16_t index, std::int64_t value) const;
  AbortCode check_mapping_count(std::uint16_t index, std::int64_t value) const;
  AbortCode check_cob_id(std::uint16_t index, std::int64_t value) const;
  std::int64_t value(std::uint16_t index, std::uint8_t subindex) const;
  bool valid(std::uint16_t communication) const { return ((value(communication, 1) >> 31) & 1) == 0; }

  std::uint64_t pack(const Pdo& pdo) const;
  void apply(Pdo& pdo);
  bool send(Pdo& pdo, std::uint64_t data);
  void sync_transmit(Pdo& pdo);

  ObjectDictionary& objects_;
  bool setup_only_pre_operational_;
  PdoOwner& owner_;
  std::array<Pdo, kCount> receive_{};
  std::array<Pdo, kCount> transmit_{};
};

}  // namespace interpolated_motion::emulation
