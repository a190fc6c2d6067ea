#include "interpolated_motion_driver/hardware/serial_link.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::hardware {

namespace {

/// A line without an end is shown in pieces of this many characters.
constexpr std::size_t kLongestLine = 200;

}  // namespace

SerialLink::SerialLink(const BusConfiguration& configuration, transport::SerialLine& line,
                       std::unique_ptr<BusDevice> device)
    : BusLink(std::move(device)), line_(line), master_(configuration.name, configuration.serial.line) {}

void SerialLink::receive(const WireObserver& observer) {
  show_sent(observer);
  while (const auto character = line_.receive()) {
    master_.on_character(character->value, character->time);
    if (character->value != '\r') received_ += character->value;
    if (character->value != '\r' && received_.size() < kLongestLine) continue;
    ++replies_;
    if (observer.text) observer.text(name(), {received_, character->time, false});
    received_.clear();
  }
}

void SerialLink::show_sent(const WireObserver& observer) {
  if (observer.text) {
    for (const Sent& sent : sent_) observer.text(name(), {sent.text, sent.time, true});
  }
  sent_.clear();
}

void SerialLink::send_outgoing(HostTime now) {
  while (const auto text = master_.peek_outgoing(now)) {
    if (!line_.send(*text, now)) break;
    ++requests_;
    sent_.push_back(
        {std::string(text->substr(0, text->find('\r'))), now + master_.characters_time(text->size())});
    master_.pop_outgoing(now);
  }
  peak_load_ = std::max(peak_load_, master_.load(now));
}

void SerialLink::fill_traffic(motion::BusSnapshot& out) const {
  out.load = master_.load();
  out.reply_delay = {seconds(master_.reply_delay()), seconds(master_.parameters().turnaround)};
  out.frames_sent = requests_;
  out.frames_received = replies_;
}

std::uint64_t SerialLink::unexpected() const {
  std::uint64_t lines = 0;
  for (int cause = 0; cause < silverlode::kUnexpectedLineCauses; ++cause)
    lines += master_.unexpected(static_cast<silverlode::UnexpectedLine>(cause)).count;
  return lines;
}

std::vector<std::string> SerialLink::unexpected_traffic() const {
  std::vector<std::string> texts;
  for (int cause = 0; cause < silverlode::kUnexpectedLineCauses; ++cause) {
    std::string text = master_.unexpected_text(static_cast<silverlode::UnexpectedLine>(cause));
    if (!text.empty()) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace interpolated_motion::hardware
