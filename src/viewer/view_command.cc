#include "viewer/commands.h"
#include "viewer/viewer.h"

namespace understudy::viewer {

void View(const ViewArguments& arguments, const std::function<bool()>& should_stop) {
  Viewer(client::ChosenSocket(arguments.robot), arguments).Run(should_stop);
}

}  // namespace understudy::viewer
