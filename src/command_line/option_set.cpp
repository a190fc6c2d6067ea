#include "interpolated_motion_driver/command_line/option_set.h"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <boost/program_options/errors.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <boost/program_options/variables_map.hpp>

#include "interpolated_motion_driver/units/closest_name.h"

namespace interpolated_motion::command_line {
namespace {

namespace po = boost::program_options;

constexpr unsigned kLineLength = 110;
constexpr const char* kHelp = "help";

double number(const std::string& name, const std::string& text, Range allowed) {
  double value = 0.0;
  if (!boost::conversion::try_lexical_convert(text, value) ||
      !(value >= allowed.low && value <= allowed.high)) {
    throw std::invalid_argument(
        fmt::format("{}: \"{}\" is not a number within {}..{}", name, text, allowed.low, allowed.high));
  }
  return value;
}

int whole_number(const std::string& name, const std::string& text, Range allowed) {
  const double value = number(name, text, allowed);
  if (value != static_cast<int>(value)) {
    throw std::invalid_argument(fmt::format("{}: \"{}\" is not a whole number", name, text));
  }
  return static_cast<int>(value);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  boost::split(words, list, boost::is_any_of(","));
  return words;
}

/// Boost takes whatever follows as the value.
void refuse_missing_value(const po::option& option) {
  const auto& tokens = option.original_tokens;
  if (tokens.size() > 1 && boost::starts_with(tokens[1], "--"))
    throw std::invalid_argument(fmt::format("{} needs a value, and {} is none", tokens[0], tokens[1]));
}

po::parsed_options parsed(const po::options_description& options, const std::vector<std::string>& arguments) {
  namespace style = po::command_line_style;
  constexpr int kFullNames = style::unix_style & ~style::allow_guessing;
  try {
    return po::command_line_parser(arguments).options(options).style(kFullNames).allow_unregistered().run();
  } catch (const po::error& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace

OptionSet::OptionSet(std::string synopsis, std::string notes)
    : synopsis_(std::move(synopsis)),
      notes_(std::move(notes)),
      options_("Options", kLineLength, kLineLength / 2),
      names_({"--help"}) {
  options_.add_options()("help,h", "prints this and ends");
}

void OptionSet::add(const Option& option, const Reader& read) {
  const std::string name = "--" + option.name;
  auto* value = po::value<std::string>();
  value->value_name(option.value)->notifier([name, read](const std::string& text) { read(name, text); });
  options_.add_options()(option.name.c_str(), value, option.meaning.c_str());
  names_.push_back(name);
}

void OptionSet::add_text(const Option& option, std::string& target) {
  add(option, [&target](const auto&, const auto& text) { target = text; });
}

void OptionSet::add_number(const Option& option, Range allowed, double& target) {
  add(option,
      [&target, allowed](const auto& name, const auto& text) { target = number(name, text, allowed); });
}

void OptionSet::add_number(const Option& option, Range allowed, std::optional<double>& target) {
  add(option,
      [&target, allowed](const auto& name, const auto& text) { target = number(name, text, allowed); });
}

void OptionSet::add_whole_number(const Option& option, Range allowed, int& target) {
  add(option,
      [&target, allowed](const auto& name, const auto& text) { target = whole_number(name, text, allowed); });
}

void OptionSet::add_switch(const std::string& name, const std::string& meaning, bool& target) {
  auto* value = po::bool_switch()->notifier([&target](bool given) { target = target || given; });
  options_.add_options()(name.c_str(), value, meaning.c_str());
  names_.push_back("--" + name);
}

void OptionSet::add_numbers(const Option& option, Range allowed, std::vector<double>& target) {
  add(option, [&target, allowed](const auto& name, const auto& list) {
    target.clear();
    for (const auto& text : split(list)) target.push_back(number(name, text, allowed));
  });
}

void OptionSet::add_whole_numbers(const Option& option, Range allowed, std::vector<int>& target) {
  add(option, [&target, allowed](const auto& name, const auto& list) {
    target.clear();
    for (const auto& text : split(list)) target.push_back(whole_number(name, text, allowed));
  });
}

void OptionSet::refuse_unknown(const std::string& argument) const {
  const std::string name = argument.substr(0, argument.find('='));
  const std::string closest = closest_name(name, names_);
  throw std::invalid_argument(closest.empty()
                                  ? fmt::format("unknown argument {}; --help lists all options", name)
                                  : fmt::format("unknown argument {}; did you mean {}?", name, closest));
}

/// A word, or a negative number, which Boost takes for an option.
bool OptionSet::is_argument(const po::option& option) const {
  double number = 0.0;
  const bool negative =
      option.unregistered && boost::conversion::try_lexical_convert(option.original_tokens.front(), number);
  return arguments_ != nullptr && (option.position_key >= 0 || negative);
}

bool OptionSet::parse(const std::vector<std::string>& arguments) const {
  const po::parsed_options found = parsed(options_, arguments);
  std::vector<std::string> words;
  for (const po::option& option : found.options) {
    if (option.string_key == kHelp) return false;
    if (is_argument(option)) {
      words.push_back(option.original_tokens.front());
      continue;
    }
    if (option.unregistered || option.position_key >= 0) refuse_unknown(option.original_tokens.front());
    if (!option.value.empty()) refuse_missing_value(option);
  }
  po::variables_map values;
  try {
    po::store(found, values);
  } catch (const po::error& error) {
    throw std::invalid_argument(error.what());
  }
  po::notify(values);
  if (arguments_ != nullptr) *arguments_ = words;
  return true;
}

std::string OptionSet::help() const {
  std::ostringstream out;
  out << synopsis_ << options_ << notes_;
  return out.str();
}

}  // namespace interpolated_motion::command_line
