#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boost/program_options/option.hpp>
#include <boost/program_options/options_description.hpp>

namespace interpolated_motion::command_line {

/// What an option is called, what stands for its value in help(), and what it means, with unit and default.
struct Option {
  std::string name;     ///< without the dashes: "timeout" is given as --timeout
  std::string value;    ///< such as SECONDS
  std::string meaning;  ///< for help(), as it is
};

/// Allowed values of a number.
struct Range {
  double low;   ///< included
  double high;  ///< included
};

/// The options of one program, read by Boost.Program_options: `--name VALUE` and `--name=VALUE`, where VALUE
/// may be a negative number, and --help or -h. Each is given at most once, by its full name. The targets that
/// add_...() name keep their value where an option is not given; they must outlive parse().
class OptionSet {
 public:
  /// `synopsis`: how the program is called and what it does. `notes`: what help() says behind the options.
  explicit OptionSet(std::string synopsis, std::string notes = "");

  /// One value: a text as it is, a number within `allowed`. A whole number may be written as 1e6; its range
  /// must be within that of int.
  void add_text(const Option& option, std::string& target);
  void add_number(const Option& option, Range allowed, double& target);
  void add_number(const Option& option, Range allowed, std::optional<double>& target);
  void add_whole_number(const Option& option, Range allowed, int& target);

  /// `--name` alone: true where it is given.
  void add_switch(const std::string& name, const std::string& meaning, bool& target);

  /// Lists: numbers with commas between them, one at least, each within `allowed`.
  void add_numbers(const Option& option, Range allowed, std::vector<double>& target);
  void add_whole_numbers(const Option& option, Range allowed, std::vector<int>& target);

  /// The words that are no options, in their order, a negative number among them; without this there must be
  /// none.
  void add_arguments(std::vector<std::string>& target) { arguments_ = &target; }

  /// Reads the arguments behind the program's name. False when help is asked for; then no target is set.
  /// Throws std::invalid_argument that names the argument, what is wrong with it and what is allowed; for an
  /// unknown option with the known one that is spelled most like it.
  bool parse(const std::vector<std::string>& arguments) const;

  /// Synopsis, all options, notes.
  std::string help() const;

 private:
  using Reader = std::function<void(const std::string& name, const std::string& text)>;

  void add(const Option& option, const Reader& read);
  bool is_argument(const boost::program_options::option& option) const;
  [[noreturn]] void refuse_unknown(const std::string& argument) const;

  std::string synopsis_;
  std::string notes_;
  boost::program_options::options_description options_;
  std::vector<std::string> names_;  ///< with the dashes
  std::vector<std::string>* arguments_ = nullptr;
};

}  // namespace interpolated_motion::command_line
