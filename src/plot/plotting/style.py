"""How the pictures look: light, one colour for each joint in all of them."""
import matplotlib

INK = "#333a44"
FAINT = "#8a929c"
GRID = "#e8ebee"
ALARM = "#c8312b"

# Told apart by the colour-blind as well, and in print: Okabe and Ito's, then darker ones.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#6b6b47", "#00404d", "#8c2d19"]

GROUP = {"starting": "#eef0f2", "disabled": "#eef0f2", "enabling": "#eef0f2", "idle": "#eef0f2", "preparing": "#d9e6f2", "moving": "#bfe3d0",
         "streaming": "#bfe3d0", "settling": "#d9e6f2", "standing": "#d9e6f2", "stopping": "#fbdcae", "fault": "#f3b7b1"}

DRIVE = {"operation enabled": "#bfe3d0", "quick stop active": "#fbdcae", "fault reaction active": "#f0937f", "fault": "#f3b7b1",
         "offline": "#5d646d"}
OTHER_STATE = "#e6e9ec"

KINDS = {"PDO": "#0072b2", "SYNC, TIME": "#56b4e9", "SDO": "#e69f00", "heartbeat": "#009e73", "NMT": "#cc79a7", "EMCY": "#c8312b",
         "other": "#8a929c", "requests": "#0072b2", "replies": "#56b4e9", "all": "#0072b2"}


def apply():
    matplotlib.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 8.5, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": "#c9ced4",
        "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8, "axes.grid": True, "axes.axisbelow": True,
        "grid.color": GRID, "grid.linewidth": 0.7, "xtick.color": FAINT, "ytick.color": FAINT, "xtick.labelcolor": INK,
        "ytick.labelcolor": INK, "xtick.major.size": 0, "ytick.major.size": 0, "lines.linewidth": 1.2, "lines.solid_capstyle": "round",
        "legend.frameon": False, "legend.handlelength": 1.2, "svg.fonttype": "none", "svg.hashsalt": "plot", "path.simplify_threshold": 0.3,
        "figure.facecolor": "white", "axes.facecolor": "white"})


def colour_of(names):
    return {name: COLOURS[i % len(COLOURS)] for i, name in enumerate(names)}
