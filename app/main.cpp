#include "app/exit_code.h"

int main(int argc, char** argv) { return softreel::app::guarded_main(argc, argv); }
