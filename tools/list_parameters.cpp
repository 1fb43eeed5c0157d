// Prints the parameters of all nodelets as Markdown, as they stand in the README.
#include <iostream>

#include "parameter_tables.h"

int main() { std::cout << datmo::parameterTables(); }
