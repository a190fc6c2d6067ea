#include "interpolated_motion_driver/commissioning/can_drive.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"
#include "interpolated_motion_driver/protocol/cia402/statusword.h"

namespace interpolated_motion::commissioning {
namespace {

namespace object = cia402::object;
using canopen::DataType;
using canopen::SdoResult;

/// A drive writes its parameters to a memory that takes its time.
constexpr HostDuration kSaveTimeout = std::chrono::seconds(5);

// CiA 301 and CiA 402: histories, stores, time stamps, commands, setpoints. 0x2062, 0x20C1 and 0x60C4: EPOS2.
constexpr std::uint16_t kNoParameters[] = {0x1003, 0x1010, 0x1011, 0x1013, 0x2062, 0x20C1,
                                           0x6040, 0x6060, 0x6071, 0x607A, 0x60B0, 0x60B1,
                                           0x60B2, 0x60C1, 0x60C4, 0x60FE, 0x60FF};

/// An object of a file of parameters.
NamedObject object_of(const Parameter& parameter, const canopen::Eds* eds) {
  auto found = find_object(parameter.number, eds);
  NamedObject object = found ? found.value() : NamedObject{};
  object.type = canopen::data_type(parameter.type);
  if (object.name.empty()) object.name = parameter.name;
  return object;
}

std::string failure_of(const SdoResult& result, const NamedObject& object) {
  const char* verb = result.direction == canopen::SdoDirection::Upload ? "read" : "write";
  if (result.abort_code == canopen::abort_code::kTimeout && !result.aborted_by_drive) {
    return fmt::format(
        "{}: node {} does not answer. Check its power, its node id and the cable; scan shows who is there",
        title(object), result.node);
  }
  return fmt::format("{}: node {} refuses the {}: {} (SDO abort 0x{:08X})", title(object), result.node, verb,
                     canopen::describe_abort(result.abort_code), result.abort_code);
}

DataType shown_type(const NamedObject& object, const SdoResult& result) {
  return object.type != DataType::Unknown ? object.type : canopen::integer_type(result.data.size(), false);
}

Parameter parameter_of(const NamedObject& object, const SdoResult& result) {
  const DataType type = shown_type(object, result);
  return {canopen::to_string(object.address), canopen::to_text(type), plain_value(result, type), object.name};
}

}  // namespace

bool is_parameter(const canopen::EdsObject& object) {
  if (object.access != canopen::ObjectAccess::ReadWrite || canopen::size_of(object.type) == 0) return false;
  const std::uint16_t index = object.address.index;
  return std::find(std::begin(kNoParameters), std::end(kNoParameters), index) == std::end(kNoParameters);
}

CanDrive::CanDrive(CanSession& session, std::uint8_t node, std::optional<canopen::Eds> eds)
    : session_(session), node_(node), eds_(std::move(eds)) {}

DriveAccess::Result<DriveIdentity> CanDrive::identity() {
  const std::pair<const char*, canopen::ObjectAddress> parts[] = {{"vendor", object::kVendorId},
                                                                  {"product", object::kProductCode},
                                                                  {"revision", object::kRevisionNumber},
                                                                  {"serial", object::kSerialNumber}};
  DriveIdentity identity{{"kind", "canopen"}};
  for (const auto& [name, address] : parts) {
    const SdoResult result = session_.read(node_, address);
    if (!result.ok && !result.aborted_by_drive)
      return failure_of(result, find_object(canopen::to_string(address), eds()).value());
    identity.emplace_back(name, result.ok ? fmt::format("0x{:08X}", result.as_u32()) : "none");
  }
  // COB-IDs among the parameters are made of it.
  identity.emplace_back("node", std::to_string(node_));
  return identity;
}

DriveAccess::Result<Shown> CanDrive::show(const std::string& name) {
  auto found = find_object(name, eds());
  if (!found) return found.error();
  const NamedObject& object = found.value();
  const SdoResult result = session_.read(node_, object.address);
  if (!result.ok) return failure_of(result, object);
  std::string text = fmt::format("{} = {}", title(object), value_text(result, object.type));
  const std::string unit = unit_of(object.address);
  if (!unit.empty()) text += " " + unit;
  const std::string facts = facts_text(object);
  if (!facts.empty()) text += fmt::format("  [{}]", facts);
  return Shown{text};
}

DriveAccess::Result<Change> CanDrive::prepare(const std::string& name, const std::string& value) {
  auto found = find_object(name, eds());
  if (!found) return found.error();
  NamedObject& object = found.value();
  if (object.eds != nullptr && object.eds->access == canopen::ObjectAccess::ReadOnly)
    return fmt::format("{} is read-only, as the EDS says", title(object));
  const SdoResult before = session_.read(node_, object.address);
  const bool write_only = before.aborted_by_drive && before.abort_code == canopen::abort_code::kWriteOnly;
  if (!before.ok && !write_only) return failure_of(before, object);
  auto bytes = value_bytes(value, object, before.data.size());
  if (!bytes) return bytes.error();
  // Without an EDS the value tells whether there is a sign.
  if (object.type == DataType::Unknown)
    object.type = canopen::integer_type(before.data.size(), value[0] == '-');
  Change change{title(object), unit_of(object.address), parameter_of(object, before), value};
  if (!before.ok) change.before.value = "(write-only)";
  return change;
}

DriveAccess::Failure CanDrive::write(const NamedObject& object, const std::string& value, std::size_t size) {
  auto bytes = value_bytes(value, object, size);
  if (!bytes) return bytes.error();
  const SdoResult result = session_.write(node_, object.address, bytes.value());
  if (!result.ok) return failure_of(result, object);
  return std::nullopt;
}

DriveAccess::Failure CanDrive::apply(const Change& change) {
  const NamedObject object = object_of(change.before, eds());
  if (auto failure = write(object, change.after, canopen::size_of(object.type))) return failure;
  const SdoResult after = session_.read(node_, object.address);
  if (!after.ok) return std::nullopt;  // write-only, or a drive that has been told to restart
  auto wanted = value_bytes(change.after, object, after.data.size());
  const bool same = wanted && std::equal(wanted.value().begin(), wanted.value().end(), after.data.data(),
                                         after.data.data() + after.data.size());
  if (same) return std::nullopt;
  return fmt::format("{}: the drive has taken the write, yet has {} now", title(object),
                     value_text(after, shown_type(object, after)));
}

DriveAccess::Failure CanDrive::save() {
  std::vector<std::uint8_t> bytes(4);
  canopen::put_le(bytes.data(), cia402::kStoreSignature);
  const HostDuration timeout = session_.timeout();
  session_.set_timeout(std::max(timeout, kSaveTimeout));
  const SdoResult result = session_.write(node_, object::kStoreParameters, bytes);
  session_.set_timeout(timeout);
  if (result.ok) return std::nullopt;
  const bool absent = result.abort_code == canopen::abort_code::kNoObject ||
                      result.abort_code == canopen::abort_code::kNoSubindex;
  if (absent) return fmt::format("node {} cannot save its parameters: it has no object 0x1010:01", node_);
  return failure_of(result, find_object("0x1010:1", eds()).value());
}

DriveAccess::Result<std::vector<Parameter>> CanDrive::parameters(const Progress& progress) {
  if (!eds_) return std::string("which objects are parameters is told by the EDS of the drive: --eds FILE");
  std::vector<SdoOrder> orders;
  for (const auto& object : eds_->objects)
    if (is_parameter(object)) orders.push_back({node_, object.address, std::nullopt});
  std::vector<Parameter> parameters;
  for (const SdoResult& result : session_.transfer(orders, progress)) {
    const NamedObject object = find_object(canopen::to_string(result.address), eds()).value();
    if (result.ok) parameters.push_back(parameter_of(object, result));
    // An EDS may describe more than this drive has; a drive that does not answer has told nothing.
    if (!result.ok && !result.aborted_by_drive) return failure_of(result, object);
  }
  return parameters;
}

DriveAccess::Result<std::vector<Change>> CanDrive::differences(const std::vector<Parameter>& wanted,
                                                               const Progress& progress) {
  std::vector<SdoOrder> orders;
  std::vector<NamedObject> objects;
  for (const Parameter& parameter : wanted) {
    auto found = find_object(parameter.number, nullptr);
    if (!found) return found.error();
    objects.push_back(object_of(parameter, eds()));
    orders.push_back({node_, found.value().address, std::nullopt});
  }
  const auto results = session_.transfer(orders, progress);
  std::vector<Change> changes;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].ok) return failure_of(results[i], objects[i]);
    auto bytes = value_bytes(wanted[i].value, objects[i], results[i].data.size());
    if (!bytes) return bytes.error();
    const Parameter before = parameter_of(objects[i], results[i]);
    if (before.value == wanted[i].value) continue;
    changes.push_back({title(objects[i]), unit_of(objects[i].address), before, wanted[i].value});
  }
  return changes;
}

DriveAccess::Failure CanDrive::why_not_restore() {
  const SdoResult result = session_.read(node_, object::kStatusword);
  if (!result.ok) return std::nullopt;
  const cia402::Statusword status{result.as_u16()};
  if (status.state() != cia402::State::OperationEnabled) return std::nullopt;
  return fmt::format("node {} is enabled ({}): switch it off before its parameters are restored", node_,
                     status.text());
}

std::vector<std::string> CanDrive::restore(const std::vector<Parameter>& wanted,
                                           const std::vector<Change>& changes) {
  std::vector<std::string> failures;
  for (const Parameter& parameter : restore_order(wanted, changes)) {
    const NamedObject object = object_of(parameter, eds());
    if (auto failure = write(object, parameter.value, canopen::size_of(object.type)))
      failures.push_back(*failure);
  }
  return failures;
}

}  // namespace interpolated_motion::commissioning
