#include "cli/program.hpp"

int main(int argc, char** argv) { return clearloci::cli::run_program(argc, argv); }
