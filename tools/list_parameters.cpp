// Prints the parameters of all nodelets as Markdown, as they stand in doc/parameters.md.
#include <iostream>

#include "parameter_tables.h"

int main() { std::cout << datmo::parameterTables(); }
