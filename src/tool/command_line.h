#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boost/program_options.hpp>

namespace split_mapf::tool {

/// The options of one subcommand. Strict: an unknown option, a stray argument, an empty value and
/// an option given twice (unless repeatable) are bad usage; names are never guessed from their
/// beginning. Options are declared first, then parse() reads the arguments.
class CommandLine {
 public:
  CommandLine(const std::string& command, const std::string& summary);

  /// An option with a value that has to be given.
  void require(const std::string& name, const std::string& value, const std::string& help);
  /// An option with a value that may be given once.
  void offer(const std::string& name, const std::string& value, const std::string& help);
  /// An option with a value that may be given any number of times.
  void offerRepeatable(const std::string& name, const std::string& value, const std::string& help);
  void offerFlag(const std::string& name, const std::string& help);

  /// Reads the arguments. Prints the help or the version and returns false when one is asked for.
  /// @throws OptionError for bad usage.
  bool parse(const std::vector<std::string>& arguments);

  bool has(const std::string& name) const;
  /// The value of an option that was given.
  std::string text(const std::string& name) const;
  std::string text(const std::string& name, const std::string& fallback) const;
  /// Every value of a repeatable option, in order.
  std::vector<std::string> texts(const std::string& name) const;
  /// A whole number between the bounds. @throws OptionError naming option, value and bounds.
  std::uint64_t wholeNumber(const std::string& name, std::uint64_t fallback, std::uint64_t least,
                            std::uint64_t most) const;
  /// A finite decimal number, at least `least`. @throws OptionError naming option and value.
  double number(const std::string& name, double fallback, double least) const;

 private:
  void check(const boost::program_options::parsed_options& parsed) const;
  void printHelp() const;
  std::string advice() const;

  std::string command_;
  std::string summary_;
  std::vector<std::string> required_;
  boost::program_options::options_description options_;
  boost::program_options::variables_map values_;
};

}  // namespace split_mapf::tool
