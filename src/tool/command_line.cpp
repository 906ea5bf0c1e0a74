#include "tool/command_line.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <locale>
#include <sstream>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf::tool {
namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpWidth = 100;
// No short options, and no guessing of names from their beginning.
constexpr int kStyle = po::command_line_style::allow_long |
                       po::command_line_style::long_allow_adjacent |
                       po::command_line_style::long_allow_next;

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

}  // namespace

CommandLine::CommandLine(const std::string& command, const std::string& summary)
    : command_(command), summary_(summary), options_("Options", kHelpWidth) {
  offerFlag("help", "print this help");
  offerFlag("version", "print the version");
}

void CommandLine::require(const std::string& name, const std::string& value,
                          const std::string& help) {
  required_.push_back(name);
  offer(name, value, help);
}

void CommandLine::offer(const std::string& name, const std::string& value,
                        const std::string& help) {
  options_.add_options()(name.c_str(), po::value<std::string>()->value_name(value), help.c_str());
}

void CommandLine::offerRepeatable(const std::string& name, const std::string& value,
                                  const std::string& help) {
  options_.add_options()(name.c_str(),
                         po::value<std::vector<std::string>>()->composing()->value_name(value),
                         help.c_str());
}

void CommandLine::offerFlag(const std::string& name, const std::string& help) {
  options_.add_options()(name.c_str(), po::bool_switch(), help.c_str());
}

bool CommandLine::parse(const std::vector<std::string>& arguments) {
  if (contains(arguments, "--help")) {
    printHelp();
    return false;
  }
  if (contains(arguments, "--version")) {
    std::cout << "split_mapf " << SPLIT_MAPF_VERSION << "\n";
    return false;
  }
  try {
    const po::parsed_options parsed =
        po::command_line_parser(arguments).options(options_).style(kStyle).run();
    check(parsed);
    po::store(parsed, values_);
  } catch (const po::error& e) {
    throw OptionError(e.what() + advice());
  }
  for (const std::string& name : required_) {
    if (!has(name)) throw OptionError("option --" + name + " is needed" + advice());
  }
  return true;
}

void CommandLine::check(const po::parsed_options& parsed) const {
  for (const po::option& option : parsed.options) {
    if (option.string_key.empty()) {
      throw OptionError("unexpected argument " + quote(option.original_tokens.front()) + advice());
    }
    if (contains(option.value, "")) {
      throw OptionError("option --" + option.string_key + " has an empty value" + advice());
    }
  }
}

bool CommandLine::has(const std::string& name) const {
  return values_.count(name) > 0 && !values_[name].defaulted();
}

std::string CommandLine::text(const std::string& name) const {
  return values_[name].as<std::string>();
}

std::string CommandLine::text(const std::string& name, const std::string& fallback) const {
  return has(name) ? text(name) : fallback;
}

std::vector<std::string> CommandLine::texts(const std::string& name) const {
  return has(name) ? values_[name].as<std::vector<std::string>>() : std::vector<std::string>();
}

std::uint64_t CommandLine::wholeNumber(const std::string& name, std::uint64_t fallback,
                                       std::uint64_t least, std::uint64_t most) const {
  if (!has(name)) return fallback;
  const std::string value = text(name);
  std::uint64_t number = 0;
  // The classic locale knows no thousands separators; digits alone keep signs out.
  std::istringstream stream(value);
  stream.imbue(std::locale::classic());
  const bool digits = value.find_first_not_of("0123456789") == std::string::npos;
  if (digits && stream >> number && number >= least && number <= most) return number;
  throw OptionError("option --" + name + ": " + quote(value) +
                    " was given, a whole number of at least " + std::to_string(least) +
                    " and at most " + std::to_string(most) + " is expected");
}

double CommandLine::number(const std::string& name, double fallback, double least) const {
  if (!has(name)) return fallback;
  const std::string value = text(name);
  double number = 0;
  std::istringstream stream(value);
  stream.imbue(std::locale::classic());
  if (stream >> std::noskipws >> number &&
      stream.peek() == std::istringstream::traits_type::eof() && std::isfinite(number) &&
      number >= least) {
    return number;
  }
  std::ostringstream bound;
  bound << least;
  throw OptionError("option --" + name + ": " + quote(value) + " was given, a number of at least " +
                    bound.str() + " is expected");
}

void CommandLine::printHelp() const {
  std::cout << "Usage: split_mapf " << command_;
  for (const std::string& name : required_) {
    std::cout << " " << options_.find(name, false).format_name() << " "
              << options_.find(name, false).semantic()->name();
  }
  std::cout << " [options]\n\n" << summary_ << "\n\n" << options_;
}

std::string CommandLine::advice() const { return "; see split_mapf " + command_ + " --help"; }

}  // namespace split_mapf::tool
