#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/emulation/canopen/abort_code.h"
#include "interpolated_motion_driver/emulation/canopen/communication_objects.h"
#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/canopen/sdo_server.h"

namespace interpolated_motion::emulation {

/// What the objects of a drive mean to it, beyond what CiA 301 says of them.
class ObjectOwner {
 public:
  virtual ~ObjectOwner() = default;

  /// What the objects are after power-up or a reset; of the latter NMT resets those below 0x2000 alone, if
  /// it is of the communication.
  virtual ObjectDictionary::Values initial_values() const = 0;

  /// Rules for writing an object that go beyond type and range and beyond what CiA 301 says of PDOs and
  /// errors.
  virtual AbortCode check_value(const ObjectEntry& entry, std::int64_t value) const = 0;

  /// A value that goes elsewhere than into its object: what becomes of it.
  virtual std::optional<AbortCode> divert(const ObjectEntry& /*entry*/, std::uint64_t /*raw*/) {
    return std::nullopt;
  }

  /// An object has been written that means nothing to the node itself.
  virtual void written(const ObjectEntry& entry, std::int64_t value) = 0;

  /// Objects derived from the state are to be brought up to date.
  virtual void publish_status() = 0;
};

/// Access to the objects of a node by SDO and by PDO, with all that writing one entails.
class ObjectAccess : public SdoObjects {
 public:
  /// Works on what it is given, which must outlive it. `device_name`: value of the object that is a string
  /// (0x1008), at most kSdoCapacity characters.
  ObjectAccess(ObjectDictionary& objects, std::string device_name, CommunicationObjects& communication,
               ObjectOwner& owner);

  AbortCode sdo_read(std::uint16_t index, std::uint8_t subindex, std::array<std::uint8_t, kSdoCapacity>& data,
                     std::size_t& size) override;
  AbortCode sdo_writable(std::uint16_t index, std::uint8_t subindex, std::size_t& object_size) override;
  AbortCode sdo_write(std::uint16_t index, std::uint8_t subindex, const std::uint8_t* data,
                      std::size_t size) override;

  /// Writes the low bytes of `raw`, as many as the object has. A value the drive refuses is lost: a PDO has
  /// no answer to carry an abort code.
  void pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw);

 private:
  AbortCode write(ObjectDictionary::Slot slot, std::size_t size, std::uint64_t raw);

  ObjectDictionary& objects_;
  const std::string device_name_;
  CommunicationObjects& communication_;
  ObjectOwner& owner_;
};

}  // namespace interpolated_motion::emulation
