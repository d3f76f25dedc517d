// The manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <ostream>

namespace evalcts::cli {

// The manual page of the program for man(7), from what the command line says of itself: each subcommand with
// its options and its footer.
void write_manual(const CLI::App& app, std::ostream& out);

}  // namespace evalcts::cli
