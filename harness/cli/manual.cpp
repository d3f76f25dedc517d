#include "harness/cli/manual.h"

#include <string>
#include <vector>

namespace evalcts::cli {
namespace {

// Text as roff has it: no request at the beginning of a line, no escape, a hyphen that can be searched for.
std::string roff(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    line_begins = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

// Lines as they are.
void verbatim(const std::string& lines, std::ostream& out) {
  out << ".PP\n.nf\n" << roff(lines);
  if (!lines.ends_with('\n')) out << '\n';
  out << ".fi\n";
}

// "TEXT", "INT", "{quick,full}": the kind of a value without what checks it, or its choices.
std::string kind_of_value(const CLI::Option& option) {
  std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos) return type;
  return type[colon + 1] == '{' ? type.substr(colon + 1) : type.substr(0, colon);
}

void write_option(const CLI::Option& option, std::ostream& out) {
  const bool takes_value = option.get_items_expected_max() > 0;
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  out << ".TP\n\\fB" << roff(name) << "\\fR";
  if (takes_value && !option.get_positional()) out << " \\fI" << roff(kind_of_value(option)) << "\\fR";
  if (!option.get_default_str().empty()) out << " [" << roff(option.get_default_str()) << "]";
  out << '\n';
  const std::string& description = option.get_description();
  out << roff(description.empty() ? "(required)" : description) << '\n';
}

void write_command(const std::string& name, const CLI::App& command, std::ostream& out) {
  out << ".SS " << roff(name) << '\n' << roff(command.get_description()) << '\n';
  for (const CLI::Option* option : command.get_options())
    // Without those that every command has, and those that are for programs.
    if (option != command.get_help_ptr() && !option->get_group().empty()) write_option(*option, out);
  // One without a footer has that of the program.
  if (command.get_footer() != command.get_parent()->get_footer()) verbatim(command.get_footer(), out);
  for (const CLI::App* part : command.get_subcommands({}))
    write_command(name + " " + part->get_name(), *part, out);
}

}  // namespace

void write_manual(const CLI::App& app, std::ostream& out) {
  out << ".TH EVALCTS 1 \"\" \"evalcts " EVALCTS_VERSION
         "\" \"User Commands\"\n"
         ".SH NAME\n"
         "evalcts \\- conformance test suite and reference oracle for OpenGL evaluators\n"
         ".SH SYNOPSIS\n"
         "\\fBevalcts\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR]...\n"
         ".SH DESCRIPTION\n"
         "Judges a GL library's evaluators (glMap1, glEvalCoord, glGetMap and their relatives) clause by "
         "clause of "
         "the\nspecification: every evaluated value against exact rational arithmetic, every error rule for "
         "its "
         "error and for what\nit must leave alone. \\fBevalcts\\-suite\\fR, the program with the tests, is a "
         "plain "
         "GoogleTest program.\n"
         ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands({}))
    if (!command->get_group().empty()) write_command(command->get_name(), *command, out);
  out << ".SH EXIT STATUS\n"
         ".TP\n0\nNothing unexpected.\n"
         ".TP\n1\nAn unexpected fail, crash or timeout.\n"
         ".TP\n2\nWrong use, or something that was asked for could not be started, read or written.\n"
         ".TP\n3\nA fault of evalcts itself.\n"
         ".SH FILES\n"
         ".TP\n\\fI./evalcts\\-results\\fR\nResults and pages, where \\fB\\-\\-output\\fR names no other "
         "folder.\n"
         ".TP\n\\fI../share/evalcts\\fR, seen from the program\n"
         "Baselines, golden vectors and the schemas of what is written.\n"
         ".SH ENVIRONMENT\n"
         ".TP\n\\fBDISPLAY\\fR\nThe X server of \\fBglx\\fR and \\fBglx\\-indirect\\fR. Without one they "
         "start an "
         "Xvfb.\n"
         ".TP\n\\fBNO_COLOR\\fR\nNo colours on terminals.\n"
         ".SH SEE ALSO\n"
         "README.md, which is installed with it, explains verdicts, baselines, providers and sinks.\n";
}

}  // namespace evalcts::cli
