"""Part of Xvfb's screen, a file in the format of xwd with 32 bits a pixel, as PNG: screen_to_png.py SCREEN PNG LEFT TOP RIGHT BOTTOM."""
import struct
import sys

from PIL import Image

screen, picture, *box = sys.argv[1:]
with open(screen, "rb") as file:
    content = file.read()
# XWDfile.h: 25 big-endian words of 32 bits, then the window's name, then colours of 12 bytes each.
head = struct.unpack(">25I", content[:100])
size, width, height, bytes_per_line, colours = head[0], head[4], head[5], head[12], head[19]
begin = size + 12 * colours
image = Image.frombuffer("RGB", (width, height), content[begin:begin + bytes_per_line * height], "raw", "BGRX", bytes_per_line, 1)
image = image.crop(tuple(map(int, box)))
image.quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(picture, optimize=True)
