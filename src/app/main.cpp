#include "app/program.h"

int main(int argc, char** argv) { return barehand::run_program(argc, argv); }
