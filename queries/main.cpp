#include "queries/shell/program.h"

int main(int argc, char** argv) {
  return queries::run_program(argc, argv);
}
