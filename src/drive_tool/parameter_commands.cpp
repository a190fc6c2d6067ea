#include <stdexcept>

#include <fmt/format.h>

#include "commands.h"
#include "interpolated_motion_driver/command_line/input_file.h"
#include "interpolated_motion_driver/command_line/output_file.h"
#include "interpolated_motion_driver/commissioning/parameter_file.h"
#include "open_drive.h"
#include "terminal.h"

namespace interpolated_motion::drive_tool {
namespace {

using commissioning::Change;
using commissioning::DriveIdentity;
using commissioning::ParameterFile;

/// The value, or the sentence why there is none as an exception.
template <class Value>
Value need(commissioning::DriveAccess::Result<Value> result) {
  if (!result) throw std::runtime_error(result.error());
  return std::move(result.value());
}

bool agreed(const Options& options, const std::string& question) {
  if (options.yes || ask(question)) return true;
  complain("nothing is written; scripts give --yes");
  return false;
}

ParameterFile read_file(const std::string& path) {
  const std::string text = command_line::read_text_file(path);
  try {
    return commissioning::parse_parameter_file(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", path, error.what()));
  }
}

/// The file, if it is of this drive.
ParameterFile read_file_of(OpenDrive& drive, const Options& options) {
  ParameterFile file = read_file(options.words.front());
  const DriveIdentity identity = need(drive->identity());
  const std::string reason = commissioning::why_another_drive(file.identity, identity, options.replacement);
  if (!reason.empty()) throw std::runtime_error(fmt::format("{}: {}", options.words.front(), reason));
  return file;
}

std::vector<Change> differences(OpenDrive& drive, const ParameterFile& file) {
  ProgressLine line("read parameters:");
  return need(drive->differences(file.parameters,
                                 [&line](std::size_t done, std::size_t all) { line.show(done, all); }));
}

bool is_parameter_file(const std::string& first_line) {
  return first_line == commissioning::kParameterFileHeader;
}

}  // namespace

ExitCode read(const Options& options) {
  OpenDrive drive(options);
  ExitCode code = Done;
  for (const std::string& name : options.words) {
    const auto shown = drive->show(name);
    if (shown) {
      say(shown.value().text);
    } else {
      complain(shown.error());
      code = Trouble;
    }
  }
  return code;
}

ExitCode write(const Options& options) {
  OpenDrive drive(options);
  const Change change = need(drive->prepare(options.words[0], options.words[1]));
  say(change.text());
  if (!agreed(options, "write it?")) return Trouble;
  if (const auto failure = drive->apply(change)) throw std::runtime_error(*failure);
  say("written; without save it is gone when the drive is switched off");
  return Done;
}

ExitCode save(const Options& options) {
  OpenDrive drive(options);
  if (!agreed(options, "let the drive keep all its present parameters without power?")) return Trouble;
  if (const auto failure = drive->save()) throw std::runtime_error(*failure);
  say("saved");
  return Done;
}

ExitCode dump(const Options& options) {
  OpenDrive drive(options);
  ParameterFile file;
  file.identity = need(drive->identity());
  {
    ProgressLine line("read parameters:");
    file.parameters =
        need(drive->parameters([&line](std::size_t done, std::size_t all) { line.show(done, all); }));
  }
  const std::string& path = options.words.front();
  const auto out =
      command_line::open_output_file(path, command_line::EarlierFile::Replace, is_parameter_file);
  const std::string text = commissioning::to_text(file);
  const bool whole =
      std::fwrite(text.data(), 1, text.size(), out.get()) == text.size() && std::fflush(out.get()) == 0;
  if (!whole) throw std::runtime_error(path + ": it cannot be written; is the disk full?");
  say(fmt::format("{} parameters written to {}", file.parameters.size(), path));
  return Done;
}

ExitCode diff(const Options& options) {
  OpenDrive drive(options);
  const ParameterFile file = read_file_of(drive, options);
  const auto changes = differences(drive, file);
  for (const Change& change : changes)
    say(fmt::format("{}: drive {}, file {} {}", change.title, change.before.value, change.after,
                    change.unit));
  say(fmt::format("{} of {} parameters differ", changes.size(), file.parameters.size()));
  return changes.empty() ? Done : Trouble;
}

ExitCode restore(const Options& options) {
  OpenDrive drive(options);
  const ParameterFile file = read_file_of(drive, options);
  const auto changes = differences(drive, file);
  if (changes.empty()) {
    say(fmt::format("all {} parameters are as in the file", file.parameters.size()));
    return Done;
  }
  if (const auto reason = drive->why_not_restore()) throw std::runtime_error(*reason);
  for (const Change& change : changes) say(change.text());
  if (!agreed(options, fmt::format("write these {}?", changes.size()))) return Trouble;
  for (const std::string& failure : drive->restore(file.parameters, changes)) complain(failure);
  const auto left = differences(drive, file);
  for (const Change& change : left) complain("not restored: " + change.text());
  if (left.empty()) say("restored; without save it is gone when the drive is switched off");
  return left.empty() ? Done : Trouble;
}

}  // namespace interpolated_motion::drive_tool
