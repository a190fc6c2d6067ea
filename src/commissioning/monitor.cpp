#include "interpolated_motion_driver/commissioning/monitor.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/protocol/cia402/identity.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"
#include "interpolated_motion_driver/protocol/cia402/statusword.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/protocol/silverlode/status_words.h"

namespace interpolated_motion::commissioning {
namespace {

namespace object = cia402::object;
using canopen::ObjectAddress;
using canopen::SdoResult;

constexpr ObjectAddress kLooks[] = {
    object::kStatusword,        object::kModeDisplay,          object::kPositionActual,
    object::kFollowingError,    object::kFollowingErrorActual, object::kUsedRecords,
    object::kMaximumBufferSize, object::kCurrentActual,        object::kSupplyVoltage,
    object::kErrorRegister,     object::kErrorHistoryCount,    object::kErrorHistoryNewest,
    object::kVendorId};

/// Registers that hold two numbers: the torque is in the low word.
constexpr std::uint16_t kTorqueRegister = 9;

/// The answers of one node.
using Answers = std::map<ObjectAddress, SdoResult>;

std::optional<SdoResult> answer(const Answers& answers, ObjectAddress address) {
  const auto found = answers.find(address);
  if (found == answers.end() || !found->second.ok) return std::nullopt;
  return found->second;
}

bool silent(const Answers& answers) {
  return std::none_of(answers.begin(), answers.end(),
                      [](const auto& entry) { return entry.second.ok || entry.second.aborted_by_drive; });
}

std::string signed_text(const std::optional<SdoResult>& result) {
  return result ? std::to_string(result->as_i64()) : "-";
}

/// EPOS2 has an object of its own for the following error.
std::string deviation_text(const Answers& answers) {
  const auto own = answer(answers, object::kFollowingError);
  return signed_text(own ? own : answer(answers, object::kFollowingErrorActual));
}

std::string buffer_text(const Answers& answers) {
  const auto used = answer(answers, object::kUsedRecords);
  const auto size = answer(answers, object::kMaximumBufferSize);
  return used && size ? fmt::format("{} of {}", used->as_u32(), size->as_u32()) : "-";
}

std::string error_text(const Answers& answers) {
  std::string text;
  const auto bits = answer(answers, object::kErrorRegister);
  if (bits && bits->as_u8() != 0) text = cia402::error_register_text(bits->as_u8());
  const auto count = answer(answers, object::kErrorHistoryCount);
  const auto newest = answer(answers, object::kErrorHistoryNewest);
  if (!count || count->as_u8() == 0 || !newest) return text.empty() ? "none" : text;
  const std::uint16_t code = newest->as_u16();
  const auto vendor = answer(answers, object::kVendorId);
  const bool maxon = vendor && vendor->as_u32() == cia402::kMaxonVendorId;
  text += fmt::format("{}last 0x{:04X}", text.empty() ? "" : "; ", code);
  if (maxon) text += fmt::format(" {}", cia402::describe_emergency(code));
  return text;
}

MonitorRow row_of(std::uint8_t node, const Answers& answers) {
  MonitorRow row;
  row.drive = fmt::format("node {}", node);
  if (silent(answers)) {
    row.state = "does not answer";
    return row;
  }
  if (const auto word = answer(answers, object::kStatusword))
    row.state = cia402::Statusword{word->as_u16()}.text();
  if (const auto mode = answer(answers, object::kModeDisplay))
    row.mode = cia402::to_text(static_cast<cia402::Mode>(mode->as_i8()));
  row.position = signed_text(answer(answers, object::kPositionActual));
  row.deviation = deviation_text(answers);
  row.buffer = buffer_text(answers);
  row.current = signed_text(answer(answers, object::kCurrentActual));
  if (const auto millivolts = answer(answers, object::kSupplyVoltage))
    row.supply = fmt::format("{:.1f} V", millivolts->as_u32() * 1e-3);
  row.errors = error_text(answers);
  return row;
}

MonitorRow row_of(LineSession& session, std::uint8_t address) {
  using silverlode::registers::kActualPosition;
  using silverlode::registers::kPositionError;
  MonitorRow row;
  row.drive = fmt::format("address {}", address);
  const auto internal = session.ask(silverlode::ris_request(address)).word();
  if (!internal) {
    row.state = "does not answer";
    return row;
  }
  const silverlode::InternalStatus status{*internal};
  const auto io = session.ask(silverlode::rio_request(address)).word();
  const bool moves = io && silverlode::IoStatus{*io}.trajectory_active();
  row.state = fmt::format("{}; {}", moves ? "moves" : "at rest", status.text());
  row.errors = status.fault() ? status.text() : "none";
  if (const auto value = session.ask(silverlode::rrg_request(address, kActualPosition)).register_value())
    row.position = std::to_string(*value);
  if (const auto value = session.ask(silverlode::rrg_request(address, kPositionError)).register_value())
    row.deviation = std::to_string(silverlode::position_error(*value));
  if (const auto value = session.ask(silverlode::rrg_request(address, kTorqueRegister)).register_value())
    row.current = std::to_string(static_cast<std::int16_t>(silverlode::low_word(*value)));
  return row;
}

struct Column {
  const char* head;
  std::string MonitorRow::*text;
};

constexpr Column kColumns[] = {{"DRIVE", &MonitorRow::drive},         {"POSITION", &MonitorRow::position},
                               {"DEVIATION", &MonitorRow::deviation}, {"BUFFER", &MonitorRow::buffer},
                               {"CURRENT", &MonitorRow::current},     {"SUPPLY", &MonitorRow::supply},
                               {"MODE", &MonitorRow::mode},           {"ERRORS", &MonitorRow::errors},
                               {"STATE", &MonitorRow::state}};

std::string cell(const MonitorRow& row, const Column& column) {
  const std::string& text = row.*column.text;
  return text.empty() ? "-" : text;
}

}  // namespace

std::vector<SdoOrder> CanMonitor::orders() const {
  std::vector<SdoOrder> orders;
  for (const std::uint8_t node : nodes_) {
    const auto absent = absent_.find(node);
    for (const ObjectAddress address : kLooks) {
      const bool lacks = absent != absent_.end() && std::find(absent->second.begin(), absent->second.end(),
                                                              address) != absent->second.end();
      if (!lacks) orders.push_back({node, address, std::nullopt});
    }
  }
  return orders;
}

std::vector<MonitorRow> CanMonitor::look() {
  std::map<std::uint8_t, Answers> answers;
  for (const SdoResult& result : session_.transfer(orders())) {
    answers[result.node][result.address] = result;
    const bool lacks = result.aborted_by_drive && (result.abort_code == canopen::abort_code::kNoObject ||
                                                   result.abort_code == canopen::abort_code::kNoSubindex);
    if (lacks) absent_[result.node].push_back(result.address);
  }
  std::vector<MonitorRow> rows;
  for (const std::uint8_t node : nodes_) rows.push_back(row_of(node, answers[node]));
  return rows;
}

std::vector<MonitorRow> LineMonitor::look() {
  std::vector<MonitorRow> rows;
  for (const std::uint8_t address : addresses_) rows.push_back(row_of(session_, address));
  return rows;
}

std::string monitor_table(const std::vector<MonitorRow>& rows) {
  std::vector<std::string> lines(rows.size() + 1);
  for (const Column& column : kColumns) {
    std::size_t width = std::string(column.head).size();
    bool filled = false;
    for (const MonitorRow& row : rows) {
      width = std::max(width, cell(row, column).size());
      filled = filled || cell(row, column) != "-";
    }
    if (!filled) continue;
    lines[0] += fmt::format("{:<{}}  ", column.head, width);
    for (std::size_t i = 0; i < rows.size(); ++i)
      lines[i + 1] += fmt::format("{:<{}}  ", cell(rows[i], column), width);
  }
  std::string text;
  for (std::string& line : lines) {
    while (!line.empty() && line.back() == ' ') line.pop_back();
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

}  // namespace interpolated_motion::commissioning
