#include <render/film/image.h>
