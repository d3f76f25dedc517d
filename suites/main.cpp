// The suite program.
#include <evalcts/suite/suite_main.h>

int main(int argc, char** argv) { return evalcts::suite_main(argc, argv); }
