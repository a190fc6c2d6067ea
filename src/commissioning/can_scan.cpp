#include "interpolated_motion_driver/commissioning/can_scan.h"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"
#include "interpolated_motion_driver/protocol/cia402/statusword.h"

namespace interpolated_motion::commissioning {
namespace {

namespace object = cia402::object;
using canopen::SdoResult;
using Nodes = std::map<std::uint8_t, CanDevice>;

/// One answer too many may be a frame that CAN has delivered twice.
constexpr std::uint64_t kManySurplusAnswers = 2;

bool answered(const SdoResult& result) { return result.ok || result.aborted_by_drive; }

/// What is asked of a node besides its device type, and where the answer goes.
struct Question {
  canopen::ObjectAddress address;
  void (*take)(CanDevice& device, const SdoResult& result);
};

constexpr Question kQuestions[] = {
    {object::kErrorRegister, [](CanDevice& d, const SdoResult& r) { d.errors = r.as_u8(); }},
    {object::kDeviceName, [](CanDevice& d, const SdoResult& r) { d.name = r.as_text(); }},
    {object::kHardwareVersion, [](CanDevice& d, const SdoResult& r) { d.hardware = r.as_text(); }},
    {object::kSoftwareVersion, [](CanDevice& d, const SdoResult& r) { d.software = r.as_text(); }},
    {object::kVendorId, [](CanDevice& d, const SdoResult& r) { d.identity.vendor = r.as_u32(); }},
    {object::kProductCode, [](CanDevice& d, const SdoResult& r) { d.identity.product = r.as_u32(); }},
    {object::kRevisionNumber, [](CanDevice& d, const SdoResult& r) { d.identity.revision = r.as_u32(); }},
    {object::kSerialNumber, [](CanDevice& d, const SdoResult& r) { d.identity.serial = r.as_u32(); }},
    {object::kStatusword, [](CanDevice& d, const SdoResult& r) { d.statusword = r.as_u16(); }},
    {object::kSupportedDriveModes, [](CanDevice& d, const SdoResult& r) { d.modes = r.as_u32(); }},
    {object::kMaximumBufferSize, [](CanDevice& d, const SdoResult& r) { d.fifo = r.as_u32(); }},
    {object::kBufferStatus, [](CanDevice& d, const SdoResult& r) { d.fifo_status = r.as_u16(); }},
};

Nodes find_nodes(CanSession& session, const Progress& progress) {
  std::vector<SdoOrder> orders;
  for (std::uint8_t node = 1; node <= canopen::kMaxNodeId; ++node)
    orders.push_back({node, object::kDeviceType, std::nullopt});
  Nodes nodes;
  for (const SdoResult& result : session.transfer(orders, progress)) {
    if (!answered(result)) continue;
    CanDevice& device = nodes[result.node];
    device.node = result.node;
    if (result.ok) device.device_type = result.as_u32();
  }
  return nodes;
}

void identify(CanSession& session, Nodes& nodes) {
  std::vector<SdoOrder> orders;
  for (const auto& [node, device] : nodes)
    for (const Question& question : kQuestions) orders.push_back({node, question.address, std::nullopt});
  const auto results = session.transfer(orders);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Question& question = kQuestions[i % std::size(kQuestions)];
    if (results[i].ok) question.take(nodes[results[i].node], results[i]);
  }
}

void add_what_was_heard(const BusTraffic& traffic, Nodes& nodes, CanScan& scan) {
  for (std::uint8_t node = 1; node <= canopen::kMaxNodeId; ++node) {
    const NodeTraffic& heard = traffic.node(node);
    const auto found = nodes.find(node);
    if (found == nodes.end()) {
      if (heard.frames > 0) scan.mute.push_back(node);
      continue;
    }
    found->second.state = heard.state;
    found->second.twice = heard.sdo_answers.surplus() >= kManySurplusAnswers;
    scan.devices.push_back(found->second);
  }
}

bool is_servo_drive(const CanDevice& device) {
  return device.device_type && (*device.device_type & 0xFFFFU) == cia402::kServoDriveProfile;
}

bool has_mode(const CanDevice& device, cia402::Mode mode) {
  return device.modes && cia402::supports(*device.modes, mode);
}

/// EPOS2: the objects of the FIFO, which its successors do not have.
bool has_pvt_fifo(const CanDevice& device) {
  return device.identity.is_maxon() && device.fifo && device.fifo_status &&
         has_mode(device, cia402::Mode::InterpolatedPosition);
}

std::string line(const char* title, const std::string& text) {
  return text.empty() ? "" : fmt::format("\n    {:<12}{}", title, text);
}

std::string versions(const CanDevice& device) {
  std::string text = device.hardware.empty() ? "" : "hardware " + device.hardware;
  if (!device.software.empty()) text += (text.empty() ? "software " : ", software ") + device.software;
  return text;
}

std::string state_text(const CanDevice& device) {
  std::string text = device.statusword ? cia402::Statusword{*device.statusword}.text() : "not told";
  if (device.state) text += fmt::format("; NMT {}", canopen::to_text(*device.state));
  if (device.errors && *device.errors != 0)
    text += "; error register: " + cia402::error_register_text(*device.errors);
  return text;
}

std::string usable_text(const CanDevice& device) {
  const std::string reason = why_unusable(device);
  return reason.empty() ? "can be used, type: " + drive_type(device) : "cannot be used: " + reason;
}

}  // namespace

CanScan scan_can(CanSession& session, bool beside_master, const Progress& progress) {
  session.listen(kListen);
  CanScan scan;
  scan.other_master = session.traffic().master_text();
  scan.asked = beside_master || scan.other_master.empty();
  Nodes nodes;
  if (scan.asked) {
    nodes = find_nodes(session, progress);
    identify(session, nodes);
  }
  add_what_was_heard(session.traffic(), nodes, scan);
  return scan;
}

std::string why_unusable(const CanDevice& device) {
  if (device.twice) {
    return fmt::format(
        "two devices answer as node {}. Disconnect one of them, or give it another node id, and scan again",
        device.node);
  }
  if (!device.device_type) return "it does not tell its device type (0x1000), which CiA 301 demands";
  if (!is_servo_drive(device)) {
    return fmt::format(
        "it is no servo drive: device type 0x1000 is 0x{:08X}, its low word must be 402 (CiA 402)",
        *device.device_type);
  }
  if (!device.modes)
    return "it does not tell its modes (0x6502), so it is not known to have one this driver uses";
  if (!drive_type(device).empty()) return "";
  if (has_mode(device, cia402::Mode::InterpolatedPosition)) {
    return "its interpolated position mode is not that of EPOS2 (0x20C4, 0x60C4), and it has no cyclic "
           "synchronous position mode (8)";
  }
  return "it has neither the interpolated position mode of EPOS2 (7) nor the cyclic synchronous position "
         "mode (8)";
}

std::string drive_type(const CanDevice& device) {
  if (device.twice || !is_servo_drive(device)) return "";
  if (has_pvt_fifo(device)) return "epos_ipm";
  return has_mode(device, cia402::Mode::CyclicSynchronousPosition) ? "cyclic" : "";
}

std::string to_text(const CanDevice& device) {
  const cia402::Identity& id = device.identity;
  std::string text = fmt::format("node {}: {}", device.node, cia402::describe_identity(id));
  if (!device.name.empty()) text += fmt::format(" (\"{}\")", device.name);
  text +=
      line("identity", fmt::format("vendor 0x{:08X}, product 0x{:08X}, revision 0x{:08X}, serial number {}",
                                   id.vendor, id.product, id.revision, id.serial));
  text += line("versions", versions(device));
  if (device.modes) text += line("modes", cia402::supported_modes_text(*device.modes));
  if (is_servo_drive(device)) text += line("state", state_text(device));
  return text + line("this driver", usable_text(device));
}

std::vector<std::string> remarks(const CanScan& scan) {
  std::vector<std::string> texts;
  if (!scan.other_master.empty()) {
    texts.push_back(fmt::format(
        "another master is on the bus, perhaps the driver node: {}. {}", scan.other_master,
        scan.asked
            ? "Answers to it and to this program may have been mixed up"
            : "Nobody was asked, since it and this program would spoil each other's transfers: stop it, or "
              "give --beside-master"));
  }
  for (const std::uint8_t node : scan.mute) {
    if (!scan.asked) continue;
    texts.push_back(fmt::format(
        "node {} is heard but answers no SDO: a master's heartbeat (this driver's is node 127 unless "
        "host_node_id says otherwise), or a node in the NMT state stopped",
        node));
  }
  if (!scan.asked && !scan.mute.empty())
    texts.push_back(fmt::format("heard were the nodes {}", fmt::join(scan.mute, ", ")));
  return texts;
}

}  // namespace interpolated_motion::commissioning
