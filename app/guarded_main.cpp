#include "app/exit_code.h"

namespace softreel::app {

int guarded_main(int, char**) { return kDone; }

}  // namespace softreel::app
