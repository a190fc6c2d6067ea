"""Motion reports, srv/GetMotionReport.srv, as `rosservice call` prints them."""
import yaml
from problems import BadInput
from session import Joint


def is_one(head):
    return b"worst_deviation:" in head


def read(path, session, _rates):
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            values = yaml.safe_load(file)
        if not values["valid"]:
            raise BadInput(f"{path}: {values['message']}")
        for name, unit, worst, final in zip(values["name"], values["unit"], values["worst_deviation"], values["final_deviation"]):
            joint = session.joints.setdefault(name, Joint(unit=unit))
            joint.worst_deviation, joint.final_deviation = float(worst), float(final)
    except (yaml.YAMLError, KeyError, TypeError, ValueError) as error:
        raise BadInput(f"{path} is no motion report as rosservice call prints it") from error
