#!/usr/bin/env python3
# Writes the files of this folder. Needs ezdxf (Debian: python3-ezdxf), a DXF library that knows nothing of ours;
# handles and dates in its files differ from run to run.
import json
import math
import pathlib

import ezdxf

D = str(pathlib.Path(__file__).parent) + '/'
pts=[(0,0),(60.25,-3.5),(97.3,20.1),(101.7,55.55),(64.4,88.8),(12.6,71.9),(-8.05,30.3)]
cases=[]
def add(name,**kw): cases.append(dict(file=name,**kw))
for ver in ['R2000','R2004','R2007','R2010','R2013','R2018']:
    doc=ezdxf.new(ver); doc.header['$INSUNITS']=4
    doc.modelspace().add_lwpolyline(pts,close=True)
    n=f'ezdxf-{ver.lower()}-polyline.dxf'; doc.saveas(D+n); add(n,points=[list(p) for p in pts],dropped=[],reversed=False)
rev=pts[::-1]
doc=ezdxf.new('R2010'); doc.header['$INSUNITS']=1
doc.modelspace().add_lwpolyline(rev+[rev[0]],close=False)
doc.saveas(D+'ezdxf-inch-clockwise-closing-point.dxf'); add('ezdxf-inch-clockwise-closing-point.dxf',points=[list(p) for p in rev+[rev[0]]],dropped=[7],reversed=True,inch=True)
for ver in ['R12','R2000','R2010']:
    doc=ezdxf.new(ver)
    if ver!='R12': doc.header['$INSUNITS']=0
    segs=[(pts[i],pts[(i+1)%7]) for i in range(7)]
    order=[0,3,6,1,5,2,4]
    msp=doc.modelspace()
    for k in order:
        a,b=segs[k]
        if k in (3,5): a,b=b,a
        msp.add_line((a[0],a[1],0),(b[0],b[1],0))
    n=f'ezdxf-{ver.lower()}-lines.dxf'; doc.saveas(D+n); add(n,points=[list(p) for p in pts],dropped=[],reversed=False)
def refuse(n,build,says,ver='R2010',unit=4):
    doc=ezdxf.new(ver); doc.header['$INSUNITS']=unit; build(doc.modelspace(),doc); doc.saveas(D+n); add(n,refused=says)
refuse('ezdxf-bulge.dxf',lambda m,d:m.add_lwpolyline([(0,0,0),(10,0,0.5),(10,10,0)],format='xyb',close=True),'bulge at vertex 1')
refuse('ezdxf-circle.dxf',lambda m,d:m.add_circle((0,0),5),"'CIRCLE'")
refuse('ezdxf-spline.dxf',lambda m,d:m.add_spline([(0,0),(5,5),(10,0)]),"'SPLINE'")
def ins(m,d):
    b=d.blocks.new('P'); b.add_lwpolyline(pts,close=True); m.add_blockref('P',(0,0))
refuse('ezdxf-insert.dxf',ins,"'INSERT'")
refuse('ezdxf-open.dxf',lambda m,d:m.add_lwpolyline(pts),'not closed')
refuse('ezdxf-metres.dxf',lambda m,d:m.add_lwpolyline(pts,close=True),'metres',unit=6)
refuse('ezdxf-two.dxf',lambda m,d:(m.add_lwpolyline(pts,close=True),m.add_lwpolyline([(x+200,y) for x,y in pts],close=True)),'2 LWPOLYLINEs')
refuse('ezdxf-r12-polyline.dxf',lambda m,d:m.add_polyline2d(pts,close=True),"'POLYLINE'",'R12')
refuse('ezdxf-mirrored-extrusion.dxf',lambda m,d:m.add_lwpolyline(pts,close=True,dxfattribs={'extrusion':(0,0,-1)}),'extrusion')
# own text and JSON
open(D+'probe-600.csv','w').write('# probed blank: 4 edges, 150 points each, 3 decimals; exactly straight\nx;y\n'+''.join(
  '%.3f;%.3f\n'%(ax+(bx-ax)*k/150,ay+(by-ay)*k/150) for (ax,ay),(bx,by) in zip([(0,0),(300,30),(270,330),(-30,300)],[(300,30),(270,330),(-30,300),(0,0)]) for k in range(150)))
add('probe-600.csv',corners=[0,150,300,450],reversed=False)
open(D+'tenths.txt','w').write('0.1 0.3\n0.2 0.6\n0.3 0.9\n0.4 1.2\n-5 2\n')
add('tenths.txt',corners=[0,3,4],reversed=False)
open(D+'clockwise.xyz','w').write('0 10 0.5\n5 10 0.5\n10 10 0.5\n10 10 0.5\n10 0 0.5\n0 0 0.5\n0 10 0.5\n')
add('clockwise.xyz',corners=[0,2,4,5],reversed=True)
open(D+'region.json','w').write('{"units": "inch", "outer": [\n {"line": {"from": [0, 0], "to": [4, 0]}},\n {"line": {"from": [4, 0], "to": [4, 2.5]}},\n {"line": {"from": [4, 2.5], "to": [0, 2.5]}},\n {"line": {"from": [0, 2.5], "to": [0, 0]}}], "holes": []}\n')
add('region.json',points=[[0,0],[4,0],[4,2.5],[0,2.5]],dropped=[],reversed=False,inch=True)
n=997
open(D+'ngon-997.json','w').write('{"points": [\n'+',\n'.join('[%.9f, %.9f]'%(250*math.cos(2*math.pi*k/n),250*math.sin(2*math.pi*k/n)) for k in range(n))+']}\n')
add('ngon-997.json',corners='all',reversed=False)
open(D+'far.csv','w').write(''.join('%s,%s\n'%(x,y) for x,y in [('123456789.1','-987654.3'),('123456790.2','-987654.3'),('123456790.2','-987653.2'),('123456789.65','-987653.2'),('123456789.1','-987653.2')]))
add('far.csv',corners=[0,1,2,4],reversed=False)
open(D+'dent.csv','w').write('0,0\n100,0\n100,100\n50,99.999999\n0,100\n')
add('dent.csv',refused='point 3 (line 4: 50, 99.999999 mm) lies 1e-06 mm inside')
open(D+'index.json','w').write('[\n'+',\n'.join(json.dumps(c) for c in cases)+'\n]\n')
