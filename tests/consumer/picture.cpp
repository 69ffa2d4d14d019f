// A program that uses librender: it links the dependencies of librender.
#include <render/io/image/image_io.h>

int main(int, char** arguments) {
  render::Image image(2, 1);
  image.pixels[1] = {1, 1, 1};
  render::write_image(arguments[1], image);
  return (render::read_image(arguments[1]).pixels[1] == image.pixels[1]).all() ? 0 : 1;
}
