#include "viewer/commands.h"
#include "viewer/viewer.h"

namespace understudy {

void View(const ViewArguments& arguments, const std::function<bool()>& should_stop) {
  Viewer(ChosenSocket(arguments.robot), arguments).Run(should_stop);
}

}  // namespace understudy
